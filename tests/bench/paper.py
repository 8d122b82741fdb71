"""What a step takes on many ranks, on paper: from one rank's time, a division, and a network."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

# sums of a step, limbs of each (src/base/exact_sum.f90), bytes of a word
SUMS_OF_A_STEP = 17 * 25 * 8
# bytes of a place in space
PLACE = 24
# points of a face that are near an impactor: a few quads around it
NEAR = 100
# share of a step that goes into moving points, not into forces: manual/kernels.md, `step large`
MOVING = 0.15
NODES = 4  # of a panel of Q9, for each quad
KILO = 1.0e3


@dataclass(frozen=True)
class Network:
    """How ranks talk to each other."""

    latency: float  # s
    bandwidth: float  # bytes/s


@dataclass(frozen=True)
class Division:
    """What the listing says of a division, of the ranks that have most."""

    chunks: int  # in all
    ranks: int
    most: int  # chunks of a rank
    nodes: int  # of a rank
    shared: int  # nodes that another rank counts
    meets: int
    sends: float  # bytes in a step
    sends_in_all: float

    @property
    def mean(self) -> float:
        """Chunks of a rank."""
        return self.chunks / self.ranks

    @property
    def imbalance(self) -> float:
        """Most chunks of a rank over their mean."""
        return self.most / self.mean


@dataclass(frozen=True)
class Bytes:
    """Memory of ranks other than the root, for each degree of freedom of the model."""

    alike: float  # whatever a rank has of it
    shared: float  # of all ranks together

    def of_rank(self, ranks: int) -> float:
        """That of one of so many."""
        return self.alike + self.shared / ranks


@dataclass(frozen=True)
class Costs:
    """Times on one rank, s, and memory, bytes."""

    quads: int  # of a chunk
    chunk: float  # a chunk in a step
    contact: float  # of one impactor, on every rank
    freedoms: float  # degrees of freedom of a chunk
    memory: Bytes


@dataclass(frozen=True)
class Node:
    """What ranks of one machine share."""

    cores: int
    bandwidth: float  # of its memory, bytes/s, all cores together
    alone: float  # that of one core
    cache: float  # bytes of the caches that each core has


@dataclass(frozen=True)
class Load:
    """A chunk in a step of a model that need not fit into the caches."""

    near: float  # s, where the caches hold all chunks of the rank
    far: float  # s, where they hold none of them
    held: float  # bytes that it has in memory
    moved: float  # bytes that a step must move


@dataclass(frozen=True)
class Step:
    """Parts of a step, s."""

    compute: float
    halo: float
    sums: float
    gather: float = 0.0
    contact: float = 0.0

    @property
    def total(self) -> float:
        """All of it; nothing is taken to be hidden behind anything else."""
        return self.compute + self.halo + self.sums + self.gather + self.contact


def read_division(listing: str) -> Division:
    """The table of ranks in a listing."""
    rows = table_of_ranks(listing)
    _, chunks, nodes, shared, meets, sends, _, _ = zip(*rows, strict=True)
    return Division(
        chunks=int(sum(chunks)),
        ranks=len(rows),
        most=int(max(chunks)),
        nodes=int(max(nodes)),
        shared=int(max(shared)),
        meets=int(max(meets)),
        sends=KILO * max(sends),
        sends_in_all=KILO * sum(sends),
    )


def counted_memory(listing: str) -> list[float]:
    """Mesh, motion and histories of each rank, MB, as the listing counts them."""
    if "\nRanks\n" not in listing:
        return [sum(float(mb) for mb in re.findall(r"memory of \D+([\d.]+) MB", listing))]
    return [sum(row[-2:]) for row in table_of_ranks(listing)]


def split_memory(most: dict[int, float], freedoms: float) -> Bytes:
    """What ranks have alike and what they share out, from memory over the number of ranks."""
    few, many = min(most), max(most)
    shared = (most[few] - most[many]) / (1.0 / few - 1.0 / many)
    return Bytes((most[few] - shared / few) / freedoms, shared / freedoms)


def table_of_ranks(listing: str) -> list[list[float]]:
    """Numbers of the table of ranks in a listing, a row for each of them."""
    return [
        [float(word) for word in line.split()]
        for line in listing.split("\nRanks\n")[1].splitlines()
        if re.fullmatch(r"\s*\d+(\s+[\d.]+){7}", line)
    ]


def imagine(chunks: int, ranks: int, known: list[Division]) -> Division:
    """A division that nobody made, from the known one with the likest number of chunks for a rank.

    Borders grow with the root of the chunks of a rank; the imbalance is as there, in whole chunks.
    """
    mean = chunks / ranks
    like = min(known, key=lambda one: abs(math.log(one.mean / mean)))
    longer = math.sqrt(mean / like.mean)
    return Division(
        chunks=chunks,
        ranks=ranks,
        most=min(chunks, math.ceil(mean * like.imbalance)),
        nodes=round(like.nodes * mean / like.mean),
        shared=round(like.shared * longer),
        meets=like.meets,
        sends=like.sends * longer,
        sends_in_all=like.sends_in_all * longer * ranks / like.ranks,
    )


def time_of_chunk(chunks: int, ranks: int, load: Load, node: Node) -> float:
    """Mean time of the chunks of a rank, s: by what the caches hold, or by the memory of the node.

    Alternate steps run through the chunks backwards, so that caches keep what they have room for.
    """
    missed = max(0.0, 1.0 - node.cache / (chunks * load.held))
    work = load.near + missed * (load.far - load.near)
    pace = min(node.alone, node.bandwidth / min(ranks, node.cores))
    return max(work, missed * load.moved / pace)


def step_of(division: Division, costs: Costs, network: Network, hit: bool = False) -> Step:
    """A step, with an impactor that presses or with none."""
    work = costs.chunk * division.most
    contact = costs.contact if hit else 0.0
    if division.ranks == 1:
        return Step(work, 0.0, 0.0, 0.0, contact)
    # nodes that several ranks have are moved by each of them
    moved_twice = MOVING * costs.chunk * division.shared / (NODES * costs.quads)
    rounds = math.ceil(math.log2(division.ranks))
    start = rounds * network.latency
    return Step(
        compute=work + moved_twice,
        halo=division.meets * network.latency + division.sends / network.bandwidth,
        sums=start + rounds * SUMS_OF_A_STEP / network.bandwidth,
        gather=(start + NEAR * PLACE / network.bandwidth) if hit else 0.0,
        contact=contact,
    )
