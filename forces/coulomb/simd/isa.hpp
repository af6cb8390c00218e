#pragma once
/// Wide vectors: which instruction set the pair kernels of this process use. The binary is portable; it
/// carries every path of its architecture and chooses at run time.
///
/// The default is the widest path this machine runs. The environment variable TREEJET_VECTOR_PATH = plain |
/// avx2 | avx512 forces another one (read once, at first use); a name that is unknown or does not run here is
/// an InputError. Results of two paths agree to round-off, not in bits.

namespace treejet {

enum class Isa { plain, avx2, avx512 };

const char* name(Isa isa);
bool runs_here(Isa isa);
Isa default_isa();

}  // namespace treejet
