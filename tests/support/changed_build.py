"""The solver with changed sources: what depends on them is compiled once more, beside a build."""

from __future__ import annotations

import gzip
import json
import re
import shlex
import subprocess
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from graphlib import TopologicalSorter
from pathlib import Path

from runs import ROOT

_MODULE = re.compile(r"^ *(?:module|program) (\w+) *$", re.MULTILINE)
_USED = re.compile(r"^ *(?:use|submodule \() *(\w+)", re.MULTILINE)


@dataclass
class ChangedBuild:
    """A build, a folder beside it, and sources of ROOT that have another text there."""

    build: Path
    folder: Path
    changed: Mapping[str, str]  # text by path
    objects: dict[str, Path] = field(default_factory=dict)  # compiled here, by their own names

    def link(self) -> Path:
        """Compile what must be, and link the program of these and of the libraries of the build."""
        altered: set[str] = set()
        for path in TopologicalSorter(self._needs).static_order():
            name = str(path.relative_to(ROOT)) if path.is_relative_to(ROOT) else str(path)
            if name in self.changed or self._used[path] & altered:
                altered |= self._compile(path, name)
        last = self._ninja("commands", "plydyn").splitlines()[-1]
        words = [str(self.objects.get(word, word)) for word in _words(last)]
        program = self.folder / "plydyn"
        words[words.index("-o") + 1] = str(program)
        first = next(place for place, word in enumerate(words) if word.endswith(".a"))
        # objects in front of the libraries take the places of those in them
        words[first:first] = [str(own) for name, own in self.objects.items() if name not in last]
        subprocess.run(words, cwd=self.build, check=True)
        return program

    def _compile(self, path: Path, name: str) -> set[str]:
        """Compile a source; gives the modules that others see otherwise now."""
        words = list(self._commands[path])
        place, own = words.index("-o") + 1, self.folder / "objects" / words[words.index("-o") + 1]
        self.objects[words[place]] = own
        words[place] = str(own)
        if name in self.changed:
            source = self.folder / name
            source.parent.mkdir(parents=True, exist_ok=True)
            source.write_text(self.changed[name], encoding="utf-8")
            words = [str(source) if word == str(path) else word for word in words]
        made = next(word for word in words if word.startswith("-J"))
        modules = self.folder / made[2:]
        words[words.index(made)] = f"-J{modules}"
        folders = [self.folder / word.relative_to(self.build) for word in self._module_folders]
        words[1:1] = [f"-I{one}" for one in (*folders, self.build / made[2:])]
        for one in (own.parent, *folders):
            one.mkdir(parents=True, exist_ok=True)
        subprocess.run(words, cwd=self.build, check=True)
        return {
            module
            for module in _MODULE.findall(self._texts[path])
            for new in modules.glob(f"{module.lower()}.*mod")
            if _content(new) != _content(self.build / made[2:] / new.name)
        }

    @cached_property
    def _commands(self) -> dict[Path, list[str]]:
        """The command of each source of the program, as words."""
        return {
            Path(one["file"]): _words(one["command"])
            for one in json.loads(self._ninja("compdb"))
            if one["file"].endswith(".f90") and one["output"].startswith("src/")
            if "-c" in _words(one["command"])
        }

    @cached_property
    def _texts(self) -> dict[Path, str]:
        """The sources, as they are to be compiled."""
        texts = {path: path.read_text(encoding="utf-8") for path in self._commands}
        return texts | {ROOT / name: text for name, text in self.changed.items()}

    @cached_property
    def _used(self) -> dict[Path, set[str]]:
        """Modules that each source uses."""
        return {path: set(_USED.findall(text)) for path, text in self._texts.items()}

    @cached_property
    def _needs(self) -> dict[Path, set[Path]]:
        """Sources that come before each."""
        homes = {name: path for path, text in self._texts.items() for name in _MODULE.findall(text)}
        return {
            path: {homes[name] for name in used if name in homes} - {path}
            for path, used in self._used.items()
        }

    @cached_property
    def _module_folders(self) -> Iterable[Path]:
        return [path for path in (self.build / "modules").iterdir() if path.is_dir()]

    def _ninja(self, *words: str) -> str:
        command = ["ninja", "-C", str(self.build), "-t", *words]
        ran = subprocess.run(command, capture_output=True, text=True, check=True)
        return "\n".join(line for line in ran.stdout.splitlines() if "Entering" not in line)


def _words(command: str) -> list[str]:
    """Words of the last command that is no `:` of a line of ninja."""
    found = [one for one in command.split(" && ") if one.strip() != ":"]
    return shlex.split(found[-1])


def _content(module: Path) -> bytes:
    """A module of gfortran without its first line, which names the source."""
    return gzip.decompress(module.read_bytes()).split(b"\n", 1)[1]
