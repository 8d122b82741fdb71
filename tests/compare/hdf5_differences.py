"""Whether two files of HDF5 hold arrays and attributes of the same bits, under whatever names."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

import h5py
import numpy as np

import known_names
from known_names import reason, renamed
from report import Report

Data = dict[str, np.ndarray]


def compare_hdf5(old: Path, new: Path, report: Report) -> None:
    """Compare arrays by name, else by what the table says, else by group, shape and content."""
    mine, others = _read(old, report), _read(new, report)
    _join_parts(old.name, mine, others, report)
    _sort_rearranged(old.name, mine, others, report)
    for name in sorted(mine):
        other = renamed(known_names.RENAMED_DATA, name)
        if other in others:
            if other != name:
                report.note(f"{old.name}: {name} is called {other}")
            _compare(old.name, name, mine.pop(name), others.pop(other), report)
    _pair_by_content(old.name, mine, others, report)
    _pair_by_shape(old.name, mine, others, report)
    _report_rest(old.name, mine, others, report)


def _read(path: Path, report: Report) -> Data:
    """All arrays and attributes of a file."""
    found: Data = {}

    def take(name: str, item: h5py.Group | h5py.Dataset) -> None:
        for key, value in item.attrs.items():
            found[f"{name}@{key}"] = np.asarray(value)
        if isinstance(item, h5py.Dataset):
            found[name] = np.asarray(item[()])

    with h5py.File(path) as file:
        take("", file)
        file.visititems(take)
    for name in list(found):
        for key, why in known_names.NOT_COMPARED.items():
            if re.fullmatch(key, name):
                del found[name]
                report.note(f"{_kind(path)}: {key} is not compared: {why}")
    return found


def _kind(path: Path) -> str:
    """A file without the number of its restart."""
    return re.sub(r"\d+$", "*", path.name)


def _compare(file: str, name: str, old: np.ndarray, new: np.ndarray, report: Report) -> None:
    """Note the first value that differs."""
    report.numbers += old.size
    why = reason(known_names.SHORTENED_DATA, name)
    if why and new.size < old.size and not old.reshape(-1)[new.size :].any():
        report.note(f"{file}: {name} has lost zeros at its end: {why}")
        old = old.reshape(-1)[: new.size]
    why = reason(known_names.LENGTHENED_DATA, name)
    if why and new.size > old.size and not new.reshape(-1)[old.size :].any():
        report.note(f"{file}: {name} has got zeros at its end: {why}")
        new = new.reshape(-1)[: old.size]
    new = _without_shifts(file, name, old, new, report)
    why = reason(known_names.WIDENED_DATA, name)
    if why and new.size > old.size and _contains(new, old):
        report.note(f"{file}: {name} has got values among the old ones: {why}")
    elif (why := reason(known_names.RESIZED_DATA, name)) and new.size != old.size:
        report.note(f"{file}: {name} has another size: {why}")
    elif _is_text(old) or _is_text(new):
        if old.tolist() != new.tolist():
            report.note(f"{file}: {name} says {new.tolist()!r}, was {old.tolist()!r}")
    elif old.dtype != new.dtype or old.size != new.size:
        report.differ(file, name, "shape", _form(old), _form(new))
    elif old.tobytes() != new.tobytes():
        place = int(np.argmax(_bits(old) != _bits(new)))
        row = tuple(int(i) for i in np.unravel_index(place, old.shape))
        values = old.reshape(-1)[place], new.reshape(-1)[place]
        count = int((_bits(old) != _bits(new)).sum())
        report.differ(file, name, f"{row}, first of {count}", *map(repr, values))
    elif old.shape != new.shape:
        report.note(f"{file}: {name} has the shape {new.shape}, was {old.shape}")


def _without_shifts(
    file: str, name: str, old: np.ndarray, new: np.ndarray, report: Report
) -> np.ndarray:
    """The new values, with the two of which the table says it as they were if their sum is."""
    for key, (one, other, why) in known_names.SHIFTED_DATA.items():
        if not re.fullmatch(key, name) or old.size != new.size or old.size <= max(one, other):
            continue
        pair = [one, other]
        mine, theirs = old.reshape(-1)[pair], new.reshape(-1)[pair]
        if mine.tobytes() != theirs.tobytes() and same_sums([mine], [theirs]):
            report.note(f"{file}: values {one} and {other} of {name} have the same sum: {why}")
            new = new.reshape(-1).copy()
            new[pair] = mine
    return new


def same_sums(old: Sequence[Sequence[float]], new: Sequence[Sequence[float]]) -> bool:
    """Whether the sums of rows are the same, but for a share of the largest number of all."""
    first, second = np.array(old, float), np.array(new, float)
    largest = max(float(np.abs(first).max()), float(np.abs(second).max()))
    difference = np.abs(first.sum(axis=1) - second.sum(axis=1)).max()
    return bool(difference <= known_names.SHIFTED_SHARE * largest)


def _contains(long: np.ndarray, short: np.ndarray) -> bool:
    """Whether values follow each other in a longer array, with others between them."""
    rest = iter(_bits(long).tolist())
    return all(value in rest for value in _bits(short).tolist())


def _is_text(values: np.ndarray) -> bool:
    """Whether these are words."""
    return values.dtype.kind in "SUO"


def _form(values: np.ndarray) -> str:
    """Type and shape."""
    return f"{values.dtype}{values.shape}"


def _bits(values: np.ndarray) -> np.ndarray:
    """Numbers as their bytes, one row each."""
    flat = np.ascontiguousarray(values).reshape(-1)
    return flat.view(np.dtype((np.void, flat.dtype.itemsize)))


def _join_parts(file: str, mine: Data, others: Data, report: Report) -> None:
    """Compare an array with those that hold its values one behind the other."""
    for name in sorted(mine):
        for old, parts in known_names.SPLIT_DATA.items():
            names = [re.sub(old, part, name) for part in parts]
            is_new = set(names) <= set(others) and not set(names) <= set(mine)
            if re.fullmatch(old, name) and is_new:
                joined = np.concatenate([others.pop(part).reshape(-1) for part in names])
                report.note(f"{file}: {name} is split into {', '.join(names)}")
                _compare(file, name, mine.pop(name).reshape(-1), joined, report)
                break


def _sort_rearranged(file: str, mine: Data, others: Data, report: Report) -> None:
    """Compare arrays that share out the same values in another way."""
    for pattern, why in known_names.REARRANGED_DATA.items():
        matches = [re.fullmatch(pattern, name) for name in sorted(mine)]
        for owner in sorted({match[1] for match in matches if match}):
            names = [
                [name for name in data if (of := re.fullmatch(pattern, name)) and of[1] == owner]
                for data in (mine, others)
            ]
            if set(names[0]) == set(names[1]):
                continue
            values = [
                np.sort(np.concatenate([data.pop(name).reshape(-1) for name in some]))
                for data, some in zip((mine, others), names, strict=True)
            ]
            report.note(f"{file}: the values of {owner} are shared out anew: {why}")
            _compare(file, owner, values[0], values[1], report)


def _group(name: str) -> str:
    """The group of an array, or what an attribute belongs to."""
    return re.split(r"[@/][^@/]*$", name)[0]


def _pair_by_content(file: str, mine: Data, others: Data, report: Report) -> None:
    """Pair what has the same bits, first within its group."""
    for near in (True, False):
        for name in sorted(mine):
            for other in sorted(others):
                if near and _group(name) != _group(other):
                    continue
                if (near or mine[name].size > 0) and _same(mine[name], others[other]):
                    report.note(f"{file}: {name} is called {other}: same bits")
                    report.numbers += mine.pop(name).size
                    del others[other]
                    break


def _same(old: np.ndarray, new: np.ndarray) -> bool:
    """Whether two arrays have the same type, size and bits."""
    if _is_text(old) or _is_text(new):
        return old.tolist() == new.tolist()
    return old.dtype == new.dtype and old.size == new.size and old.tobytes() == new.tobytes()


def _pair_by_shape(file: str, mine: Data, others: Data, report: Report) -> None:
    """Compare what is alone of its type and size in its group, and say where it differs."""
    for name in sorted(mine):
        alike = [other for other in others if _alike(name, mine[name], other, others[other])]
        rivals = [rival for rival in mine if _alike(name, mine[name], rival, mine[rival])]
        if len(alike) == len(rivals) == 1:
            report.note(f"{file}: {name} is taken for {alike[0]}, the only one of its shape")
            _compare(file, name, mine.pop(name), others.pop(alike[0]), report)


def _alike(name: str, values: np.ndarray, other: str, their: np.ndarray) -> bool:
    """Whether two arrays may be the same by group, type and size."""
    same_form = values.dtype == their.dtype and values.size == their.size
    return _group(name) == _group(other) and same_form


def _report_rest(file: str, mine: Data, others: Data, report: Report) -> None:
    """What only one of the builds has."""
    for name, values in sorted(mine.items()):
        if why := reason(known_names.DROPPED_DATA, name):
            report.note(f"{file}: {name} is written no longer: {why}")
        else:
            report.differ(file, name, "", _form(values), "nothing")
    for name, values in sorted(others.items()):
        if why := reason(known_names.ADDED_DATA, name):
            report.note(f"{file}: {name} is new: {why}")
        else:
            report.differ(file, name, "", "nothing", _form(values))
