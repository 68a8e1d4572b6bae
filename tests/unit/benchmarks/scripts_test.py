"""The parts of the measuring scripts that decide: run by ctest, or by python3 -m unittest."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "benchmarks"))

from blocks import blocks_of  # noqa: E402
from counting import parse  # noqa: E402


class Callgrind(unittest.TestCase):
    def test_own_cost_counts_and_that_of_callees_does_not(self):
        profile = """positions: instr line
events: Ir
fn=outer
0x10 0 3
cfn=inner
calls=3 0x40 0
0x12 0 999
0x12 0 3
fn=inner
0x40 7 6
fn=inner'2
0x40 7 1
totals: 13""".splitlines()
        self.assertEqual(parse(profile), {0x10: 3, 0x12: 3, 0x40: 7})


def blocks(code, counts):
    return [(block.instructions, block.executions) for block in
            blocks_of([(address, text, "f") for address, text in code], counts)]


class Blocks(unittest.TestCase):
    def test_a_loop_is_a_block_of_its_own(self):
        code = [(1, "movl a"), (2, "addl b"), (3, "jne    2 <f+0x1>"), (4, "movl c"), (5, "retl")]
        self.assertEqual(blocks(code, {1: 1, 2: 8, 3: 8, 4: 1, 5: 1}),
                         [(["movl a"], 1), (["addl b", "jne    2 <f+0x1>"], 8),
                          (["movl c", "retl"], 1)])

    def test_two_loops_of_equal_counts_stay_two(self):
        code = [(1, "addl a"), (2, "jne    1 <f>"), (3, "addl b"), (4, "jne    3 <f+0x2>")]
        self.assertEqual([len(b) for b, _ in blocks(code, dict.fromkeys(range(1, 5), 8))], [2, 2])

    def test_a_jump_forward_that_is_never_taken_does_not_cut(self):
        code = [(1, "addl a"), (2, "je     9 <f+0x8>"), (3, "addl b")]
        self.assertEqual([len(b) for b, _ in blocks(code, {1: 5, 2: 5, 3: 5})], [3])

    def test_a_jump_forward_that_is_sometimes_taken_does(self):
        code = [(1, "addl a"), (2, "je     9 <f+0x8>"), (3, "addl b")]
        self.assertEqual([len(b) for b, _ in blocks(code, {1: 5, 2: 5, 3: 4})], [2, 1])

    def test_what_never_falls_through_cuts(self):
        for last in ("jmp    9 <f+0x8>", "calll  40 <g>", "retl", "notrack jmp *%eax"):
            code = [(1, "addl a"), (2, last), (3, "addl b")]
            self.assertEqual([len(b) for b, _ in blocks(code, {1: 5, 2: 5, 3: 5})], [2, 1], last)

    def test_code_that_is_not_executed_is_in_no_block(self):
        code = [(1, "addl a"), (2, "nop"), (3, "addl b")]
        self.assertEqual(blocks(code, {1: 5, 3: 5}), [(["addl a"], 5), (["addl b"], 5)])


if __name__ == "__main__":
    unittest.main()
