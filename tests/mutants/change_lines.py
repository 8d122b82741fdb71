"""Changes of one line of Fortran, each of which a test should notice."""

from __future__ import annotations

import re

#: Pattern of the code, and what takes its place
RULES: list[tuple[str, str]] = [
    (r" \+ ", " - "),
    (r" - ", " + "),
    (r"(?<=[\w)])\*(?=[\w(])", "/"),
    (r"(?<=[\w)])/(?=[\w(])", "*"),
    (r"= -(?=[\w(])", "= "),
    (r" <= ", " < "),
    (r" >= ", " > "),
    (r" < ", " <= "),
    (r" > ", " >= "),
    (r" == ", " /= "),
    (r" /= ", " == "),
    (r"\.and\.", ".or."),
    (r"\.or\.", ".and."),
    (r"\.not\. ?", ""),
    (r"\.true\.", ".false."),
    (r"\.false\.", ".true."),
    (r"\bmin\(", "max("),
    (r"\bmax\(", "min("),
    (r"\b0\.0_wp", "1.0_wp"),
    (r"\b0\.5_wp", "1.0_wp"),
    (r"\b1\.0_wp", "2.0_wp"),
    (r"\b2\.0_wp", "1.0_wp"),
]
#: Lines that say what there is, not what is done
_STILL = re.compile(
    r"\s*($|!|#|use\b|implicit\b|private\b|public\b|contains\b|import\b|interface\b|module\b"
    r"|end\b|else\s*$|do\s*$|select\b|case\b|associate\b|type\b|procedure\b|generic\b|allocate\b"
    r"|((pure|impure|elemental|recursive|logical|integer|real|character|class)\b.*"
    r"(\bfunction\b|\bsubroutine\b|::))|function\b|subroutine\b)"
)
#: Statements that can go: calls and assignments
_GOES = re.compile(r"\s*(call\b|return\b|cycle\b|exit\b|[\w%]+(\([^=]*\))?(%\w+(\([^=]*\))?)* = )")


def changes(line: str, before: str = "") -> list[str]:
    """All changes of a line, which the line before it may continue into."""
    if _STILL.match(line):
        return []
    code = _code(line)
    found = []
    for pattern, other in RULES:
        for match in re.finditer(pattern, code):
            found.append(line[: match.start()] + other + line[match.end() :])
    whole = not (code.rstrip().endswith("&") or before.rstrip().endswith("&"))
    if whole and _GOES.match(code):
        found.append("")
    return found


def _code(line: str) -> str:
    """The line with blanks in place of its strings and its remark."""
    code, quote = [], ""
    for k, letter in enumerate(line):
        if quote:
            quote = "" if letter == quote else quote
            code.append(" ")
        elif letter == "!":
            return "".join(code) + " " * (len(line) - k)
        else:
            quote = letter if letter in "\"'" else ""
            code.append(" " if quote else letter)
    return "".join(code)
