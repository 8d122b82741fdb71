"""Samples of the profiler, without running it."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from profile_step import read_samples

TOLD = """
# Samples: 9  of event 'cpu-clock'
# Overhead       Samples  Symbol
    40.00%            40  [.] __plydyn_law_ply_damage_MOD_update_points
    30.00%            30  [.] __plydyn_element_plate_q9_le1_MOD_scatter
    15.00%            15  [.] __plydyn_element_plate_q9_le1_MOD_line_flux
     5.00%             5  [k] clear_page_erms
     4.00%             4  [.] __plydyn_element_interface_stored_energy_MOD_add_interface_energy
     3.00%             3  [.] plydyn_prefetch
     3.00%             3  [.] __memmove_avx512_unaligned_erms
"""


def test_samples_are_counted_by_parts_of_a_step() -> None:
    """Each procedure belongs to the first part whose beginning fits."""
    assert dict(read_samples(TOLD)) == {
        "law of plies": 40,
        "columns of plies to points and back": 30,
        "strain, flux and forces of plies": 15,
        "system": 5,
        "rows of energies": 4,
        "requests to the memory": 3,
        "other": 3,
    }
