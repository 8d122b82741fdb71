"""Curves, profiles and pictures of plydyn results.

```python
import plydyn_post as post

job = post.open("results/plate")  # or the job that plydyn_pre.run gives
print(job.numbers()["peak force"])
force = job.history("impactor_1").frame()
job.figure("force", "force.png")
```
"""

from plydyn_post.errors import ResultsError
from plydyn_post.interfaces import Interface
from plydyn_post.job import Job
from plydyn_post.job import open_job as open
from plydyn_post.ply_stress import PlyStress
from plydyn_post.table import Table

__all__ = ["Interface", "Job", "PlyStress", "ResultsError", "Table", "open"]
