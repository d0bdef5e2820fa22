// SPDX-License-Identifier: MIT
#pragma once

namespace sphmbs::examples {

/// What a session shows of a system: specialised for a gas (gas_session.hpp) and for a structure
/// (structure_session.hpp).
///   collection                    name of the list of its files, and of these
///   columns()                     of the history, filled by sample(row)
///   prepare()                     the system for its first output
///   banner(settings)              lines below the notes
///   heed(settings, report)        warnings
///   progress(state)               adds its counts
///   write(folder, title, number, pictures)
///                                 files of one time; @return the names of those to be listed
///   phases()                      parts of the time that steps take
///   summarise(summary)            adds its counts and what it conserves
///   guard(guards), watch(report)  of a gas: what is done where some gets lost, and a look at that
///   visit_state(archive)          what it has gathered, where it gathers; see core/archive.hpp
template <class System>
class Display;

}  // namespace sphmbs::examples
