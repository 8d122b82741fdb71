"""Spack's recipe of plydyn-pre, to be built from a clone: see manual/hpc.md."""

from spack.package import PythonPackage, depends_on, license, variant, version


class PyPlydynPre(PythonPackage):
    """Recipes of impacts on laminates, made into plydyn decks."""

    license("Apache-2.0")
    version("0.2.0")
    variant("report", default=True, description="With plydyn-post, which makes the reports")

    build_directory = "preprocessor"

    depends_on("python@3.11:", type=("build", "run"))
    depends_on("py-setuptools@77:", type="build")
    depends_on("py-numpy@1.26:", type=("build", "run"))
    # the Python module of gmsh is in its package, from 4.13
    depends_on("gmsh@4.13:", type="run")
    depends_on("py-typer@0.15:", type=("build", "run"))
    depends_on("py-rich@13:", type=("build", "run"))
    depends_on("plydyn", type="run")
    depends_on("py-plydyn-post", type="run", when="+report")
