#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the words that docs/glossary.md lists as not for users, in string literals of the program and in its screens."""
import re
import subprocess
import sys

GLOSSARY = 'docs/glossary.md'
CODE = ('core/', 'importers/', 'materials/', 'optimizer/', 'scanners/', 'pointclouds/', 'survey/', 'project/',
        'emulated-ui/', 'editor/', 'cli/', 'python/')


def patterns():
    text = open(GLOSSARY, encoding='utf-8').read()
    block = re.search(r'Words that no user reads.*?```[a-z]*\n(.*?)```', text, re.S)
    if not block:
        sys.exit(f'{GLOSSARY}: the list "Words that no user reads" is missing')
    return [line for line in block.group(1).splitlines() if line.strip()]


def sentences(path):
    """Place and text of each string that holds more than one word; adjacent literals count as one."""
    text = open(path, encoding='utf-8').read()
    if path.endswith('.json'):
        for match in re.finditer(r'"en"\s*:\s*"((?:[^"\\]|\\.)*)"', text):
            yield text.count('\n', 0, match.start()) + 1, match.group(1)
        return
    text = re.sub(r'^\s*(//|#).*$', '', text, flags=re.M)
    for match in re.finditer(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*', text):
        joined = re.sub(r'"\s*"', '', match.group(0))[1:-1]
        if ' ' in joined and len(joined) >= 12:
            yield text.count('\n', 0, match.start()) + 1, joined


def main():
    odd = re.compile('|'.join(f'(?:{p})' for p in patterns()))
    files = subprocess.run(['git', 'ls-files', '*.cpp', '*.h', 'emulated-ui/*.json'], capture_output=True, text=True,
                           check=True).stdout.split()
    found = [f'{path}:{line}: {text}' for path in files if path.startswith(CODE)
             for line, text in sentences(path) if odd.search(text)]
    for row in found:
        print(row)
    if found:
        print(f'Words: {len(found)} texts hold words of the list in {GLOSSARY}.')
    return 1 if found else 0


sys.exit(main())
