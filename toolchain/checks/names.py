"""One name, one thing: has each type one definition?

Two types of one name in two files are no error to a compiler, which sees one file at a time, nor to a linker, which takes
the constructors of either for both. Here they are found by their qualified names, whether or not a program links both. Sources
are formatted: what begins in the first column stands in a namespace.
"""
import re

NAMESPACE = re.compile(r"^(?:inline )?namespace(?: ([\w:]+))? \{")
END = re.compile(r"^\}  // namespace")
TYPE = re.compile(r"^(?:template <.*> )?(?:struct|class|union|enum class|enum) (?:alignas\(.*?\) |\[\[\w+\]\] )*(\w+)(?: final)?(?: :.*| : .*)?(?: \{.*)?$")
ALIAS = re.compile(r"^(?:template <.*> )?using (\w+) =")


def definitions(text):
    """Yields (line, qualified name) of the types that other files could see."""
    spaces = []
    for number, line in enumerate(text.split("\n"), 1):
        if found := NAMESPACE.match(line):
            if "}" not in line:
                spaces.append(found.group(1))
        elif END.match(line):
            if spaces:
                spaces.pop()
        elif None not in spaces and (found := TYPE.match(line) or ALIAS.match(line)):
            yield number, "::".join([*spaces, found.group(1)])


def check(root, files):
    """Yields (file, line, what is right)."""
    first = {}
    for file in files:
        if file.suffix not in (".cpp", ".hpp"):
            continue
        for line, name in definitions((root / file).read_text()):
            other, its_line = first.setdefault(name, (file, line))
            if other != file:
                yield file, line, f"{name} is also in {other}:{its_line}; one name, one thing: its folder's namespace, or another name"
