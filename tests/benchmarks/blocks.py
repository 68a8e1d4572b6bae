"""Straight-line blocks of a program's code."""
import re
import subprocess
from dataclasses import dataclass

from machine import tool


@dataclass
class Block:
    """Straight-line code: entered at its first instruction, left after its last."""
    function: str
    instructions: list
    executions: float

    def weight(self):
        return len(self.instructions) * self.executions


def disassembled(binary):
    """(address, instruction, function) in the order of addresses, in AT&T syntax."""
    run = subprocess.run([tool("objdump", "binutils"), "-d", "-C", "--no-show-raw-insn",
                          "-M", "att,suffix", binary], capture_output=True, text=True, check=True)
    function = "?"
    for line in run.stdout.splitlines():
        if header := re.fullmatch(r"[0-9a-f]+ <(.*)>:", line):
            function = header[1]
        elif code := re.fullmatch(r"\s*([0-9a-f]+):\t(.*)", line):
            yield int(code[1], 16), code[2].split("#")[0].strip(), function


def jump_target(instruction):
    direct = re.match(r"j\w+\s+([0-9a-f]+) <", instruction)
    return int(direct[1], 16) if direct else None


def blocks_of(code, counts):
    """The executed part of `code`, cut after jumps back, after what never falls through, at the
    targets of jumps back, and wherever the count changes: a jump forward that is never taken does
    not cut."""
    code = list(code)
    targets = {target for address, instruction, _ in code
               if (target := jump_target(instruction)) is not None and target <= address}
    blocks, open_block = [], None
    for address, instruction, function in code:
        executions = counts.get(address, 0)
        if open_block and (executions != open_block.executions or address in targets):
            open_block = None
        if not executions:
            continue
        if open_block is None:
            open_block = Block(function, [], executions)
            blocks.append(open_block)
        open_block.instructions.append(instruction)
        target = jump_target(instruction)
        if re.match(r"(notrack )?(jmp|call|ret|rep)", instruction) or (
                target is not None and target <= address):
            open_block = None
    return blocks
