"""Spack's recipe of plydyn-post, to be built from a clone: see manual/hpc.md."""

from spack.package import PythonPackage, depends_on, license, version


class PyPlydynPost(PythonPackage):
    """Curves, profiles and pictures of plydyn results."""

    license("Apache-2.0")
    version("0.2.0")

    build_directory = "postprocessor"

    depends_on("python@3.11:", type=("build", "run"))
    depends_on("py-setuptools@77:", type="build")
    depends_on("py-numpy@2:", type=("build", "run"))
    depends_on("py-h5py@3.11:", type=("build", "run"))
    depends_on("vtk@9.6:+python", type=("build", "run"))
    depends_on("py-pyvista@0.47:", type=("build", "run"))
    depends_on("py-matplotlib@3.9:", type=("build", "run"))
    depends_on("py-pillow@10:", type=("build", "run"))
    depends_on("py-rich@13:", type=("build", "run"))
    depends_on("py-typer@0.15:", type=("build", "run"))
