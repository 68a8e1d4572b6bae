"""Does each C++ file include what it names?

Of the standard library, Eigen and GoogleTest: by name, because a compiler does not miss a header that another one brings
along, until that other one, or the compiler, changes. A .cpp may rely on its own header. Of this project: the preset
`debug` compiles each file by itself.
"""
import re

# Header: the names after std:: that it is included for.
STANDARD = {
    "algorithm": "all_of any_of none_of find find_if find_if_not count count_if copy copy_n copy_if fill fill_n generate transform reverse "
                 "rotate sort stable_sort nth_element partial_sort lower_bound upper_bound equal_range binary_search max_element min_element "
                 "minmax_element min max minmax clamp replace remove remove_if unique shuffle equal mismatch lexicographical_compare "
                 "for_each is_sorted partition search set_difference merge adjacent_find swap_ranges",
    "array": "array to_array",
    "atomic": "atomic atomic_flag",
    "bit": "bit_cast popcount countr_zero countl_zero bit_width endian has_single_bit",
    "charconv": "from_chars to_chars",
    "chrono": "chrono",
    "cmath": "sqrt cbrt pow exp log log2 log10 sin cos tan asin acos atan atan2 hypot fabs floor ceil round lround llround trunc isfinite isnan "
             "isinf copysign remainder fmod nextafter erf erfc lerp ldexp frexp nearbyint lrint nan signbit tanh sinh cosh",
    "complex": "complex",
    "condition_variable": "condition_variable",
    "csignal": "signal raise sig_atomic_t",
    "cstdint": "int8_t uint8_t int16_t uint16_t int32_t uint32_t int64_t uint64_t intptr_t uintptr_t",
    "cstdio": "printf fprintf snprintf fopen fclose fread fwrite fputs fflush puts fseek ftell perror FILE fgets ferror feof",
    "cstdlib": "getenv abort exit EXIT_SUCCESS EXIT_FAILURE malloc free aligned_alloc strtol strtod strtoul system",
    "cstring": "memcpy memmove memset memcmp strlen strcmp strncmp strerror strchr strstr",
    "deque": "deque",
    "exception": "exception exception_ptr current_exception rethrow_exception terminate",
    "filesystem": "filesystem",
    "fstream": "ifstream ofstream fstream",
    "functional": "function plus minus greater less multiplies reference_wrapper cref bind_front invoke",
    "iomanip": "setprecision setw setfill quoted",
    "iostream": "cout cerr cin clog",
    "iterator": "back_inserter istreambuf_iterator ostream_iterator next prev distance advance make_move_iterator ssize",
    "limits": "numeric_limits",
    "list": "list",
    "map": "map multimap",
    "memory": "unique_ptr shared_ptr weak_ptr make_unique make_shared addressof enable_shared_from_this",
    "mutex": "mutex lock_guard unique_lock scoped_lock",
    "new": "bad_alloc nothrow align_val_t launder",
    "numbers": "numbers",
    "numeric": "accumulate inner_product iota partial_sum reduce transform_reduce midpoint gcd",
    "optional": "optional nullopt make_optional",
    "queue": "queue priority_queue",
    "random": "mt19937 mt19937_64 normal_distribution uniform_real_distribution uniform_int_distribution bernoulli_distribution",
    "regex": "regex regex_match regex_search smatch",
    "set": "set multiset",
    "span": "span as_bytes",
    "sstream": "ostringstream istringstream stringstream",
    "stdexcept": "runtime_error invalid_argument logic_error out_of_range domain_error length_error",
    "string": "string to_string stoi stod getline",
    "string_view": "string_view",
    "system_error": "error_code system_error errc generic_category system_category",
    "thread": "thread this_thread jthread",
    "tuple": "tuple tie make_tuple apply",
    "type_traits": "is_same_v is_integral_v is_floating_point_v is_trivially_copyable_v conditional_t decay_t remove_cvref_t enable_if_t "
                   "underlying_type_t is_enum_v is_arithmetic_v",
    "unordered_map": "unordered_map",
    "unordered_set": "unordered_set",
    "utility": "move forward pair make_pair swap exchange as_const unreachable",
    "variant": "variant visit holds_alternative get_if monostate",
    "vector": "vector",
}
HEADER_OF = {name: header for header, names in STANDARD.items() for name in names.split()}
# Headers that are there for the names of another one.
ALSO = {"ostringstream": ["sstream"], "string_view": ["string_view", "string"], "getline": ["string", "iostream"], "move": ["utility", "algorithm"],
        "swap": ["utility", "algorithm"], "exchange": ["utility"], "cerr": ["iostream", "ostream"]}
STANDARD_NAME = re.compile(r"\bstd::(\w+)")
# A macro or a namespace, and how the header that it needs begins.
OTHERS = [
    (re.compile(r"\bEigen::"), ("Eigen/", "unsupported/Eigen/"), "<Eigen/Core>"),
    (re.compile(r"\b(TEST|TEST_F|TEST_P|EXPECT_[A-Z_]+|ASSERT_[A-Z_]+)\("), ("gtest/", "gmock/"), "<gtest/gtest.h>"),
    (re.compile(r"\b(EXPECT_THAT|ASSERT_THAT|MOCK_METHOD)\("), ("gmock/",), "<gmock/gmock.h>"),
    (re.compile(r"\bcv::"), ("opencv2/",), "<opencv2/...>"),
    (re.compile(r"\bassert\("), ("cassert",), "<cassert>"),
]
INCLUDE = re.compile(r'^#include [<"]([^>"]+)[>"]', re.M)


def code_of(text):
    """The text without comments and strings, line by line as it was."""
    def blank(match):
        found = match.group(0)
        return "\n" * found.count("\n") if found.startswith("/") else '""' + "\n" * found.count("\n")
    text = re.sub(r"^#include.*$", "", text, flags=re.M)
    return re.sub(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"', blank, text, flags=re.S)


def missing(text, own_header=""):
    """Yields (line, name, header) of what a file names and does not include."""
    included = set(INCLUDE.findall(text)) | set(INCLUDE.findall(own_header))
    told = set()
    for number, line in enumerate(code_of(text).split("\n"), 1):
        for name in STANDARD_NAME.findall(line):
            header = HEADER_OF.get(name)
            if header and header not in told and not included.intersection(ALSO.get(name, [header])):
                told.add(header)
                yield number, "std::" + name, f"<{header}>"
        for pattern, beginnings, header in OTHERS:
            found = pattern.search(line)
            if found and header not in told and not any(file.startswith(beginnings) for file in included):
                told.add(header)
                yield number, found.group(0).rstrip("("), header


def check(root, files):
    """Yields (file, line, what is right)."""
    texts = {file: (root / file).read_text() for file in files if file.suffix in (".cpp", ".hpp")}
    for file, text in texts.items():
        own_header = texts.get(file.with_suffix(".hpp"), "") if file.suffix == ".cpp" else ""
        for line, name, header in missing(text, own_header):
            yield file, line, f"{name} without #include {header}"
