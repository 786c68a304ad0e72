#!/usr/bin/env python3
"""Refuses calls in engine/ whose bits depend on the C library, the C++ library or the version of Eigen: sines, powers and
the like of <cmath> (engine/base/mathematics.hpp has our own), Eigen's functions that call them (engine/base/rotation.hpp),
and distributions of <random>. Functions that IEEE 754 defines exactly (sqrt, floor, fmod ...) are free. render/ is free
too: no number of a run depends on a picture, and pictures are compared with a tolerance.

usage: calls_test.py [TREE]     (the tree that it lies in, if none is named)
"""
import pathlib
import re
import sys

INEXACT = ("sin cos tan asin acos atan atan2 sincos sinh cosh tanh asinh acosh atanh exp exp2 expm1 log log2 log10 log1p "
           "logb pow cbrt hypot erf erfc tgamma lgamma beta riemann_zeta").split()
# A call by std:: or by no name before it. A member (a.log), a qualified name (math::sin) or a declaration is none.
CALL = re.compile(rf"(?<![\w.:>~])(?:std::|::)?(?:{'|'.join(INEXACT)})[fl]?\s*\(")
NAMED = re.compile(rf"(?<![\w:])std::(?:{'|'.join(INEXACT)})[fl]?\b(?!\s*\()")  # as an argument: transform(..., std::sin)
OTHERS = re.compile(r"\bstd::(?:polar|arg|lerp|\w+_distribution|default_random_engine|shuffle)\b"
                    r"|\bAngleAxis\w*|\bRotation2D\w*|\.(?:slerp|angularDistance|eulerAngles|canonicalEulerAngles|"
                    r"stableNorm|blueNorm|hypotNorm|setFromTwoVectors)\(|\bFromTwoVectors\(|\bEigen::FFT\b")
# What is neither code: comments, texts (also raw ones) and characters.
NO_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])+\'', re.DOTALL)
OURS = ("engine/base/mathematics.hpp", "engine/base/circular.cpp", "engine/base/exponential.cpp")  # they declare such names


def code_of(text):
    """The code alone, with as many lines."""
    return NO_CODE.sub(lambda found: '""' + "\n" * found[0].count("\n"), text)


def faults_of(name, text):
    faults = []
    for number, line in enumerate(code_of(text).split("\n"), 1):
        found = [*NAMED.findall(line), *(m[0] for m in OTHERS.finditer(line))]
        if name not in OURS:
            found += [m[0] for m in CALL.finditer(line)]
        elif "std::" in line:
            found += [m[0] for m in CALL.finditer(line) if m[0].startswith("std::")]
        faults += [f"{name}:{number}: {one.strip('. (')}" for one in found]
    return faults


def check_itself():
    """That the patterns know a call when they see one."""
    refused = ["std::sin(x)", "y = 2*pow(x, 2)", "::exp(x)", "std::cosf (x)", "apply(std::log)", "a.slerp(0.5, b)",
               "Eigen::AngleAxisd(a, b)", "std::normal_distribution<double> d", "std::sqrt(-2 * std::log(u))"]
    free = ["math::sin(x)", "std::sqrt(x)", "// std::sin(x)", '"sin(x)"', "rule.exp(x)", "blog(x)", 'R"(pow(2))"',
            "logger->log(spdlog::level)", "std::fmod(a, b)"]
    wrong = [one for one in refused if not faults_of("x", one)] + [one for one in free if faults_of("x", one)]
    if wrong:
        sys.exit(f"the patterns are wrong about {wrong}")


def main():
    check_itself()
    tree = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2])
    files = sorted((tree / "engine").rglob("*.[ch]pp"))
    if not files:
        sys.exit("nothing to look at")
    faults = [fault for file in files for fault in faults_of(str(file.relative_to(tree)), file.read_text())]
    for fault in faults:
        print(f"{fault}: engine/ computes with engine/base/mathematics.hpp and rotation.hpp")
    print(f"{len(files)} files, {len(faults)} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
