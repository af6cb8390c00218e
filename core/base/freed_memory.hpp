#pragma once
/// What becomes of memory that is freed.

namespace treejet {

/// From here on it is kept for the next table of this process. The tables of a long jet come and go with
/// every step and every row of output; as glibc has it, each of more than 32 MB goes back to the system and
/// is made of new, cleared pages the next time: a tenth of the time of a million beads. The process grows to
/// what it has needed at one time, and by a few percent where the gaps between tables do not fit. Other C
/// libraries do as they do.
void keep_freed_memory();

}  // namespace treejet
