"""Parameters of a deck: names for numbers and text, and what is computed of them."""

from __future__ import annotations

import ast
import math
import operator
import re
from collections import ChainMap
from collections.abc import Callable
from typing import Any

from plydyn_pre.translate.numbers import number_of

_BINARY: dict[type, Callable[..., Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
    ast.Mod: math.fmod,
}
_CALLS: dict[str, Callable[..., Any]] = {
    "log": math.log,
    "ln": math.log,
    "abs": abs,
    "min": min,
    "max": max,
    "mod": math.fmod,
    "int": math.trunc,
    "float": float,
    "nint": lambda x: math.floor(x + 0.5),
    "sign": lambda a, b: math.copysign(abs(a), b),
}
_PLAIN = ("sin", "cos", "tan", "asin", "acos", "atan", "atan2", "exp", "sqrt", "log10")
_CALLS |= {name: getattr(math, name) for name in _PLAIN}
_LARGEST_POWER = 400.0


class Parameters:
    """Names of a deck; those that are local to a file hide others."""

    def __init__(self) -> None:
        """Begin without names."""
        self.names: ChainMap[str, str] = ChainMap({}, {}, {"PI": repr(math.pi)})

    def put(self, name: str, value: str, local: bool) -> None:
        """Give a name its value; ValueError where its scope has another one."""
        scope = self.names.maps[0 if local else -2]
        if scope.setdefault(name.upper(), value) != value:
            raise ValueError(f"{name} is {scope[name.upper()]} already")

    def filled(self, word: str) -> str:
        """A field with its parameter replaced; KeyError for one that is not there."""
        if word.startswith("<") and word.endswith(">"):
            return f"{self.value_of(word[1:-1]):.15g}"
        match = re.fullmatch(r"([-+]?)&(.*)", word)
        if match is None:
            return word
        value = self.names[match[2].strip().upper()]
        number = number_of(value)
        return value if number is None or match[1] != "-" else f"{-number:.15g}"

    def value_of(self, text: str) -> float:
        """The value of an expression; ValueError or KeyError where it has none."""
        text = re.sub(r"(\d)[dD]([-+]?\d)", r"\1e\2", text.replace("&", ""))
        try:
            value = self._value(ast.parse(text.strip().replace("^", "**"), mode="eval").body)
        except (SyntaxError, TypeError, ArithmeticError, RecursionError, MemoryError) as error:
            raise ValueError(text.strip()) from error
        if not isinstance(value, (int, float)) or not math.isfinite(value):
            raise ValueError(text.strip())
        return float(value)

    def _value(self, node: ast.expr) -> float:
        """The value of a part of an expression."""
        match node:
            case ast.Constant(value=int() | float() as number):
                return number
            case ast.Name():
                found = number_of(self.names[node.id.upper()])
                if found is None:
                    raise ValueError(node.id)
                return int(found) if found == int(found) and abs(found) < 1e9 else found
            case ast.UnaryOp(op=ast.USub() | ast.UAdd()):
                value = self._value(node.operand)
                return -value if isinstance(node.op, ast.USub) else value
            case ast.BinOp() if type(node.op) in _BINARY:
                left, right = float(self._value(node.left)), float(self._value(node.right))
                if isinstance(node.op, ast.Pow) and abs(right) > _LARGEST_POWER:
                    raise ValueError("power")
                return _BINARY[type(node.op)](left, right)
            case ast.Call(func=ast.Name(id=name), keywords=[]) if name.lower() in _CALLS:
                return _CALLS[name.lower()](*map(self._value, node.args))
        raise ValueError("expression")
