"""Spack's recipe of plydyn, to be built from a clone: see manual/hpc.md."""

from spack.package import CMakePackage, depends_on, license, version


class Plydyn(CMakePackage):
    """Explicit finite elements for impact on composite laminates, layer by layer."""

    license("Apache-2.0")
    version("0.2.0")

    depends_on("c", type="build")
    depends_on("fortran", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("hdf5@1.10.5:+fortran")
    depends_on("lapack")
    depends_on("metis@5:~int64")
    depends_on("mpi")

    def cmake_args(self) -> list[str]:
        """No instruction set: Spack tells compilers that of its target, in their own spelling."""
        return [self.define("PLYDYN_MACHINE", "")]
