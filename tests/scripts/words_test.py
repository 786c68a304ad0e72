#!/usr/bin/env python3
"""Do tests ask for key words of a message, and not for its sentences?

Counts HasSubstr with six words or more. tells() of tests/support/tells.hpp is for messages. A few long texts are no
messages but values: a line of a file that is written, or the sizes of a box. Their number may not rise. Three files test
sentences on purpose.
"""
import re
import sys
from pathlib import Path

TESTS = Path(__file__).resolve().parent.parent
ON_PURPOSE = {"scene/messages_test.cpp", "cli/verbs/options_test.cpp"}
MOST = 14
TEXT = re.compile(r'HasSubstr\(\s*((?:"(?:[^"\\]|\\.)*"\s*)+)\)')


def sentences():
    for path in sorted(TESTS.rglob("*.[ch]pp")):
        if str(path.relative_to(TESTS)) in ON_PURPOSE:
            continue
        text = path.read_text(encoding="utf-8")
        for match in TEXT.finditer(text):
            words = "".join(re.findall(r'"((?:[^"\\]|\\.)*)"', match[1]))
            if len(words.split()) >= 6:
                yield f"{path.relative_to(TESTS)}:{text.count(chr(10), 0, match.start()) + 1}: {words}"


found = list(sentences())
if len(found) > MOST:
    print(f"{len(found)} texts of six words or more, and {MOST} may be; write tells({{key words}}) for a message:", *found, sep="\n")
sys.exit(len(found) > MOST)
