"""Spellings of stacking sequences that papers and drawings have, in the plain one."""

from __future__ import annotations

import re

_SAME = str.maketrans("［］／（）−–—‐＋", "[]/()----+", "°º$\u200b")
_SUBSCRIPTS = "₀₁₂₃₄₅₆₇₈₉ₛₜ"
_SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹"
_DIGITS = str.maketrans(_SUBSCRIPTS + _SUPERSCRIPTS, "0123456789st0123456789")
_SMALL = re.compile(f"_?([{_SUBSCRIPTS}{_SUPERSCRIPTS}]+)")
_DEGREES = re.compile(r"(?<=\d)\s*deg(?:rees?)?(?![a-z])", re.IGNORECASE)
_BAR = re.compile(r"\\(?:bar|overline)\{?([-+±]?\d+(?:\.\d+)?)\}?|([-+±]?\d+)[\u0304\u0305]")
_AROUND = re.compile(r"[({<](.*)[)}>]((?:_?\{\w+\}|_?\w*)\s*)", re.DOTALL)
_SEPARATOR = re.compile(r"\s*[,;|]\s*|(?<=[\w)~}])\s+(?=[-+±∓(\w])")


def plain_notation(text: str) -> str:
    """The plain spelling: signs of one meaning, subscripts, brackets, separators."""
    text = text.strip().translate(_SAME)
    text = _BAR.sub(lambda match: f"{match[1] or match[2]}~", text)
    text = _SMALL.sub(lambda match: "_{" + match[1].translate(_DIGITS) + "}", text)
    text = _DEGREES.sub("", text)
    if "[" not in text and "]" not in text:
        text = _bracketed(text)
    first, last = text.find("["), text.rfind("]")
    if 0 <= first < last:
        inner = text[first + 1 : last]
        if inner.count("[") == inner.count("]"):
            inner = inner.replace("[", "(").replace("]", ")") if _is_nested(inner) else inner
            inner = inner if re.search("[/(]", inner) else _SEPARATOR.sub("/", inner.strip())
            text = f"{text[: first + 1]}{inner}{text[last:]}"
    return text


def _bracketed(text: str) -> str:
    """A sequence in other brackets, or in none."""
    match = _AROUND.fullmatch(text)
    if match and _is_nested(match[1]) and re.search(r"[/,; |]", match[1]):
        return f"[{match[1]}]{match[2]}"
    if re.match(r"[-+±∓(]*\d", text) and re.search(r"[/,; |]", text):
        return f"[{text}]"
    return text


def _is_nested(text: str) -> bool:
    """Whether no bracket of a text closes one from outside."""
    depth = 0
    for mark in text:
        depth += (mark in "[(") - (mark in "])")
        if depth < 0:
            return False
    return depth == 0
