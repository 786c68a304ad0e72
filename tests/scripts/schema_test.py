#!/usr/bin/env python3
"""The schemas that `grainreel schema` prints take every shipped scene and study, and refuse wrong ones.

schema_test.py PROGRAM SOURCE. jsonschema (Debian: python3-jsonschema) judges.
"""
import json
import pathlib
import subprocess
import sys
import tomllib

try:
    import jsonschema
except ImportError:
    print('skipped: jsonschema (python3-jsonschema) is missing')
    sys.exit(77)

GOOD = """
[[species]]
name = "beads"
count = 50
diameter = "3 mm"
density = "2.5 g/cm3"
[container]
shape = "box"
width = "40 mm"
depth = "20 mm"
height = "80 mm"
[drive]
frequency = "20 Hz"
g_level = 3
"""

# What is replaced in GOOD, what replaces it, and a word that the validator's complaint must have.
WRONG = [
    ('count = 50', 'count = 50.5', 'integer'),
    ('count = 50', 'count = 0', 'minimum'),
    ('count = 50', 'count = "50"', 'integer'),
    ('count = 50', 'coutn = 50', 'coutn'),
    ('name = "beads"', '', 'name'),
    ('name = "beads"', 'name = 3', 'string'),
    ('diameter = "3 mm"', '', 'diameter'),
    ('diameter = "3 mm"', 'diameter = -0.003', 'anyOf'),
    ('diameter = "3 mm"', 'diameter = "mm"', 'anyOf'),
    ('diameter = "3 mm"', 'diameter = "9,5 mm"', 'anyOf'),
    ('diameter = "3 mm"', 'diameter = true', 'anyOf'),
    ('diameter = "3 mm"', 'diameter = {low = 1, high = 2}', 'anyOf'),
    ('density = "2.5 g/cm3"', 'density = "2.5 g/cm3"\nmass = "1 g"', 'not'),
    ('density = "2.5 g/cm3"', 'density = 1e30', 'anyOf'),
    ('shape = "box"', 'shape = "cube"', 'enum'),
    ('shape = "box"', '', 'shape'),
    ('width = "40 mm"', '', 'width'),
    ('depth = "20 mm"', '', 'depth'),
    ('height = "80 mm"', '', 'height'),
    ('width = "40 mm"', 'widht = "40 mm"', 'widht'),
    ('width = "40 mm"', 'width = [1, 2]', 'anyOf'),
    ('[drive]', '[drvie]', 'drvie'),
    ('frequency = "20 Hz"', '', 'frequency'),
    ('frequency = "20 Hz"', 'frequency = 0', 'anyOf'),
    ('g_level = 3', 'g_level = 3\namplitude = "1 mm"', 'not'),
    ('g_level = 3', 'g_level = "3 g"', 'anyOf'),
    ('g_level = 3', 'g_level = 3\n[run]\nduration = "long"', 'anyOf'),
    ('g_level = 3', 'g_level = 3\n[run]\nseed = -1', 'minimum'),
    ('g_level = 3', 'g_level = 3\n[film]\nsize = "big"', 'anyOf'),
    ('g_level = 3', 'g_level = 3\n[film]\nstyle = "noir"', 'enum'),
    ('g_level = 3', 'g_level = 3\n[film.camera]\nazimuth = "20 mm and more, really"\nelevatoin = 3', 'elevatoin'),
    ('g_level = 3', 'g_level = 3\n[contact]\nrestitution = 2', 'anyOf'),
    ('g_level = 3', 'g_level = 3\n[[film.plot]]\nrange = [0, 1, 2]', 'maxItems'),
    ('g_level = 3', 'g_level = 3\n[[film.segment]]\nkind = "slow"', 'enum'),
    ('g_level = 3', 'g_level = 3\n[film]\nghost = "beads"', 'array'),
]


def checked(program, kind):
    """The validator of the schema of this kind of file; the schema itself is checked too."""
    schema = json.loads(subprocess.run([program, 'schema', kind], check=True, capture_output=True).stdout)
    jsonschema.Draft7Validator.check_schema(schema)
    return jsonschema.Draft7Validator(schema)


def complaints(validator, scene):
    return [f'{"/".join(map(str, error.path))}: {error.validator}: {error.message}'
            for error in validator.iter_errors(scene)]


def main(program, source):
    scenes, studies = checked(program, 'scene'), checked(program, 'study')
    failures = []
    for validator, folder in ((scenes, 'scenes'), (studies, 'scenes/studies')):
        files = sorted(pathlib.Path(source, folder).glob('*.toml'))
        assert files, folder
        for file in files:
            failures += [f'{file}: {text}' for text in complaints(validator, tomllib.loads(file.read_text()))]
    failures += [f'the good scene: {text}' for text in complaints(scenes, tomllib.loads(GOOD))]
    for old, new, word in WRONG:
        assert GOOD.count(old) == 1, old
        texts = complaints(scenes, tomllib.loads(GOOD.replace(old, new)))
        if not any(word in text for text in texts):
            failures.append(f'{old!r} -> {new!r} is taken, or refused without the word {word!r}: {texts}')
    print('\n'.join(failures) or f'{len(WRONG)} wrong scenes are refused, all shipped ones are taken')
    return 1 if failures else 0


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
