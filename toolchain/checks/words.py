"""Sizes, places and words: what a reader, and not a compiler, would stumble over."""
import re

LONGEST = 320  # lines
SOURCES = {".cpp", ".hpp", ".h", ".java", ".py", ".sh"}
# Where what is read together with the code lies; documents may say more.
CODE = ("agent/", "drivers/", "msgs/", "toolchain/", "tests/", ".ci/", ".github/", "README.md", "CMake")
CITED = [
    (re.compile(r"\b(DESIGN|SPEC|WORDING|FIELD)\b(?=[ .,:;)]|$)(?! ?=)"), "no document of this name is here"),
    (re.compile(r"\b[Ii]ssues? \d+|\b(the|an?|this|that) issue('s)?\b|\bissue's\b|\b[Ii]ssue \"|\bissue and\b", re.I), "an issue is no place to look something up"),
    (re.compile(r"\b([Ii]ssue|PR|[Pp]ull request|[Ss]ee|[Ff]ixes|[Cc]loses)s? #\d+|\(#\d+\)"), "an issue is no place to look something up"),
]
DOCUMENT = re.compile(r"[\w./-]*\b[A-Z]{2,}[\w-]*\.md\b")  # README.md, ../msgs/README.md
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)\s]*)?(?: \"[^\"]*\")?\)|src=\"([^\"]+)\"")
MACHINES = [
    (re.compile(r"(?<![\w.}])/(work|workspace|root|Users)/\w|(?<![\w.}])/home/(?!nao\b)\w"), "a path of one machine"),
    (re.compile(r"\b[\w-]*(artifactory|jfrog|nexus|devpi|proxpi|goproxy|registry|mirrors?)[\w-]*\.[\w-]+\.\w+|\b[\w-]+\.(internal|corp|lan)\b"),
     "a package host; the machine's own configuration knows it"),
]
CODE_SPAN = re.compile(r"`([^`]+)`")
SOURCE_NAME = re.compile(r"[\w./]*\w+\.[ch]pp")
IDENTIFIER = re.compile(r"[A-Za-z_]\w*((::|\.)\w+)*(\(\))?")
LIBRARY = re.compile(r"^\s*gazed_library\((\w+)", re.M)


def is_source(file, text):
    return file.suffix in SOURCES or text.startswith("#!")


def check_length(file, text):
    length = text.count("\n")
    if is_source(file, text) and length > LONGEST:
        yield LONGEST + 1, f"{length} lines; {LONGEST} at most: split it by what its parts do"


def check_place(file, text):
    if file.suffix in (".cpp", ".hpp") and len(file.parts) == 2 and file.parts[0] == "agent":
        yield 1, "a loose source; each belongs into a folder that is a library"
    if file.name == "CMakeLists.txt":
        for found in list(LIBRARY.finditer(text))[1:]:
            yield text.count("\n", 0, found.start()) + 1, f"a second library, {found.group(1)}; one a folder"


def check_words(file, text):
    for number, line in enumerate(text.split("\n"), 1):
        for pattern, problem in CITED:
            if found := pattern.search(line):
                yield number, f"'{found.group(0)}': {problem}; say what is meant, or name a file of this repository"
                break
        for pattern, problem in MACHINES:
            if found := pattern.search(line):
                yield number, f"'{found.group(0)}': {problem}"


def check_links(file, text, root):
    for number, line in enumerate(text.split("\n"), 1):
        for name in DOCUMENT.findall(line):
            if not any((folder / name).exists() for folder in (root, root / file.parent)):
                yield number, f"'{name}' is not in this repository (looked for from its root and from here); say what is meant"
        if file.suffix == ".md":
            for link in (a or b for a, b in LINK.findall(line)):
                if not re.match(r"[a-z]+:", link) and not (root / file.parent / link).exists():
                    yield number, f"the link '{link}' leads nowhere; it starts from {file.parent}/"


def cited_source(root, file, line, name):
    """The file that a document calls NAME: seen from the root, from the document's folder, or from a folder that the same line links to."""
    links = [a or b for a, b in LINK.findall(line)]
    places = [root / name, root / file.parent / name, *(root / file.parent / link / name for link in links)]
    return next((place for place in places if place.is_file()), None)


def check_cited_names(file, text, root):
    """In documents: `file.cpp`, `Name`: what is named after a file stands in it, or in the header or source of the same name."""
    for number, line in enumerate(text.split("\n"), 1):
        spans = list(CODE_SPAN.finditer(line))
        for before, after in zip(spans, spans[1:]):
            if line[before.end():after.start()] != ", " or not SOURCE_NAME.fullmatch(before.group(1)):
                continue
            name = after.group(1)
            source = cited_source(root, file, line, before.group(1))
            if source is None or SOURCE_NAME.fullmatch(name) or not IDENTIFIER.fullmatch(name):
                continue
            both = "".join(other.read_text() for suffix in (".cpp", ".hpp") if (other := source.with_suffix(suffix)).is_file())
            last = re.split(r"::|\.", name.removesuffix("()"))[-1]
            if not re.search(rf"\b{re.escape(last)}\b", both):
                yield number, f"{before.group(1)} has no '{last}'"


def check(root, files):
    """Yields (file, line, what is right)."""
    for file in files:
        try:
            text = (root / file).read_text()
        except UnicodeDecodeError:
            continue  # a picture
        found = [*check_length(file, text), *check_place(file, text)]
        if file.suffix == ".md":
            found += check_cited_names(file, text, root)
        if file.parts[:2] != ("toolchain", "checks"):  # which names what it looks for
            found += check_links(file, text, root)
            if str(file).startswith(CODE) and file.suffix not in (".json", ".svg"):
                found += check_words(file, text)
        for line, problem in found:
            yield file, line, problem
