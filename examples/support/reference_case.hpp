// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "support/session.hpp"

namespace sphmbs::examples {

/// Says in the banner where nothing is compared, as the reference is of another case.
template <class System>
void note_reference(Session<System>& session, bool same_case) {
  if (!same_case)
    session.note("reference",
                 "none for these parameters: nothing is compared, all curves are drawn");
}

/// Draws everything that was recorded over time, a panel each, where there is nothing to compare
/// with.
template <class System>
void draw_recorded(Session<System>& session) {
  std::vector<Panel> panels;
  for (History* history : {&session.history(), &session.traces()})
    for (const auto& column : history->columns()) {
      Panel panel;
      panel.title = column.name;
      panel.x_label = "t [s]";
      panel.y_label = "[" + column.unit + "]";
      panel.curves = {history->curve(column.name, "")};
      panels.push_back(std::move(panel));
    }
  const int count = static_cast<int>(panels.size());
  if (count > 0) session.curves("history", session.title(), panels, count < 4 ? count : 4);
}

/// Compares where the case is the reference's, and draws what was recorded otherwise.
template <class System, class Compare>
void compare_if(bool same_case, Session<System>& session, Compare&& compare) {
  if (same_case)
    compare();
  else
    draw_recorded(session);
}

}  // namespace sphmbs::examples
