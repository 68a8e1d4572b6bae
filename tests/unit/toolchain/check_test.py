"""toolchain/check finds what it is for, says where, and says nothing of what is right."""
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

CHECK = Path(__file__).resolve().parents[3] / "toolchain/check"
RIGHT = "#include <string>\n\nnamespace gazed::gaze {\n\nstruct Step {\n  std::string reason;\n};\n\n}  // namespace gazed::gaze\n"


@unittest.skipUnless(shutil.which("git"), "no git")
class Check(unittest.TestCase):
    def findings(self, **files):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(["git", "init", "--quiet", folder], check=True)
            for name, text in files.items():
                file = Path(folder, name.replace("__", "/").replace("_DOT_", "."))
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(text)
            run = subprocess.run([CHECK, "--root", folder], capture_output=True, text=True)
            self.assertEqual(run.returncode, 1 if run.stdout else 0, run.stderr)
            return run.stdout.splitlines()

    def expect(self, start, **files):
        found = self.findings(**files)
        self.assertEqual(len(found), 1, found)
        self.assertTrue(found[0].startswith(start), found)

    def test_what_is_right(self):
        self.assertEqual(self.findings(agent__gaze__step_DOT_hpp=RIGHT, README_DOT_md="[step](agent/gaze/step.hpp), see README.md\n"), [])

    def test_length(self):
        self.expect("agent/gaze/step.cpp:321: 321 lines", agent__gaze__step_DOT_cpp="\n" * 321)

    def test_place(self):
        self.expect("agent/step.cpp:1: a loose source", agent__step_DOT_cpp="")
        self.expect("drivers/CMakeLists.txt:2: a second library, b",
                    drivers__CMakeLists_DOT_txt="gazed_library(a SOURCES a.cpp)\ngazed_library(b SOURCES b.cpp)\n")

    def test_citations(self):
        for text in ("as in SP" + "EC 2", "(DES" + "IGN 4.2)", "of " + "NAO" + ".md 1.3", "is" + "sue 5: 3 mrad", "the is" + "sue's table", "see #" + "12"):
            self.expect("agent/gaze/step.cpp:1: ", agent__gaze__step_DOT_cpp=f"// {text}\n")
        self.expect("README.md:2: the link 'agent/gone.hpp'", README_DOT_md="\n[gone](agent/gone.hpp)\n")

    def test_names_of_cited_files(self):
        for cited in ("`agent/gaze/step.hpp`, `Stride`", "[gaze](agent/gaze) `step.hpp`, `Step::length()`"):
            self.expect("README.md:1: ", agent__gaze__step_DOT_hpp=RIGHT, README_DOT_md=cited + "\n")
        for cited in ("`agent/gaze/step.hpp`, `Step::reason`", "`agent/gaze/step.hpp`, `1 s`", "`gone.hpp`, `Step`"):
            self.assertEqual(self.findings(agent__gaze__step_DOT_hpp=RIGHT, README_DOT_md=cited + "\n"), [])

    def test_machines(self):
        self.expect("toolchain/x:1: ", toolchain__x="cd /wo" + "rk/gazed\n")
        self.expect("toolchain/x:1: ", toolchain__x="pip install -i https://arti" + "factory.example.com/simple\n")
        self.assertEqual(self.findings(toolchain__x="home=/home/nao/gazed; cp a \"$root/home\"\n"), [])

    def test_includes(self):
        self.expect("agent/gaze/step.hpp:4: std::string without #include <string>",
                    agent__gaze__step_DOT_hpp=RIGHT.replace("#include <string>\n\n", ""))
        # A .cpp may rely on its own header; words in comments and strings are none of the code's.
        self.assertEqual(self.findings(agent__gaze__step_DOT_hpp=RIGHT, agent__gaze__step_DOT_cpp="// std::vector\nstd::string a = \"std::map\";\n"), [])

    def test_two_types_of_one_name(self):
        self.expect("drivers/sim/step.hpp:5: gazed::gaze::Step is also in agent/gaze/step.hpp:5",
                    agent__gaze__step_DOT_hpp=RIGHT, drivers__sim__step_DOT_hpp=RIGHT)
        other = RIGHT.replace("gazed::gaze", "gazed::sim")
        self.assertEqual(self.findings(agent__gaze__step_DOT_hpp=RIGHT, drivers__sim__step_DOT_hpp=other), [])
        hidden = RIGHT.replace("struct", "namespace {\nstruct").replace("};\n", "};\n}  // namespace\n")
        self.assertEqual(self.findings(agent__gaze__step_DOT_hpp=RIGHT, drivers__sim__step_DOT_hpp=hidden), [])


if __name__ == "__main__":
    unittest.main()
