"""Recipe for Spack: spack repo create ours; cp package.py ours/packages/treejet/; spack repo add ours; spack install treejet"""

from spack.package import *


class Treejet(CMakePackage):
    """Electrospinning jets as chains of charged viscoelastic beads."""

    git = "file:///path/to/treejet"  # a checkout, or the address of a repository

    license("BSD-3-Clause")
    version("main", branch="main")

    variant("mpi", default=True, description="Ranks")
    variant("python", default=True, description="treejet view, plot, movie, sweep, converge, export")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("eigen@3.4:")
    depends_on("fmt")
    depends_on("cli11", type="build")
    depends_on("nlohmann-json@3.10:", type="build")
    depends_on("hdf5@1.10.7:~mpi")
    depends_on("zlib-api")
    depends_on("mpi@3:", when="+mpi")
    with when("+python"):
        depends_on("python@3.9:", type="run")
        depends_on("py-numpy", type="run")
        depends_on("py-h5py", type="run")
        depends_on("py-matplotlib", type="run")

    def cmake_args(self):
        return [self.define("TREEJET_TESTS", False), self.define_from_variant("TREEJET_MPI", "mpi")]
