#!/usr/bin/env python3
"""Makes PTX of the kernels for graphics cards with clang alone, and holds it against what their bits need: a kernel for
every pair of laws; nothing called, which a card would have to link; no local memory; roots, divisions and fused products
that round to nearest, and no doubles flushed to zero. Ends with 77 where no clang is.

usage: ptx_test.py [CLANG]
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
NO_CLANG = 77
WITHOUT_TOOLKIT = [
    "-x", "cuda", "--cuda-device-only", "--cuda-gpu-arch=sm_70", "-nocudainc", "-nocudalib", "-Wno-unknown-cuda-version",
    "-D__host__=__attribute__((host))", "-D__device__=__attribute__((device))"]
AS_THE_PROCESSOR = ["-std=c++20", "-O3", "-ffp-contract=off", "-fno-math-errno", "-DEIGEN_NO_CUDA",
                    "-DEIGEN_DONT_VECTORIZE", "-isystem", "/usr/include/eigen3", "-I", str(ROOT)]
FORBIDDEN = {"a call": r"\bcall\b", "local memory": r"\.local\b", "a rounded root": r"sqrt\.approx",
             "a rounded division": r"div\.(approx|full)", "doubles flushed to zero": r"\.ftz\.f64"}
NEEDED = ("fma.rn.f64", "sqrt.rn.f64", "div.rn.f64")


def laws():
    """How many pairs of laws have kernels: three for each linear one, and one for each line of its own."""
    text = (ROOT / "engine/card/laws.hpp").read_text()
    listed = text[text.index("#define GRAINREEL_CARD_LAWS"):]
    return 3 * listed.count("GRAINREEL_CARD_LINEAR_LAWS(X") + len(re.findall(r"^ +X\(", listed, re.MULTILINE))


def ptx_by(clang):
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "card.ptx"
        subprocess.run([clang, *WITHOUT_TOOLKIT, *AS_THE_PROCESSOR, "-S", "-o", out, ROOT / "engine/card/kernels.cu"],
                       check=True)
        return out.read_text()


def main():
    names = sys.argv[1:] or ["clang++-14", "clang++"]
    clang = next((found for found in map(shutil.which, names) if found), None)
    if clang is None:
        print("no clang here")
        return NO_CLANG
    ptx = ptx_by(clang)
    wrong = [f"{what}: {found.group()}" for what, text in FORBIDDEN.items() if (found := re.search(text, ptx))]
    wrong += [f"lacks {name}" for name in NEEDED if name not in ptx]
    kernels, wanted = len(re.findall(r"\.entry", ptx)), 3 + 2 * laws()
    if kernels != wanted:
        wrong.append(f"{kernels} kernels, wanted {wanted}")
    print("\n".join(wrong) or f"{kernels} kernels, {len(ptx)} bytes by {clang}")
    return 1 if wrong else 0


sys.exit(main())
