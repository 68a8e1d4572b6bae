// What is to be said of a fixation, in sentences and in the cells of tables.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "agent/cycle/fixation.hpp"
#include "agent/geometry/rig.hpp"

namespace gazed::lab::explain {

using Cells = std::vector<std::string>;
struct Table {
  Cells header;
  std::vector<Cells> rows;
};

/// How the fixation ended, in a sentence: the range with its intervals, or why there is none.
[[nodiscard]] std::string answer_sentence(const cycle::Fixation& fixation);
/// One line for a list of fixations.
[[nodiscard]] std::string summary_line(const cycle::Fixation& fixation);

/// A row for each look, whether it saw the target or not.
[[nodiscard]] Table table_of_looks(const cycle::Fixation& fixation);

/// The report's own six steps beside this answer, and how far they are apart.
[[nodiscard]] std::string report_sentence(const cycle::Fixation& fixation);

/// Whether the epipoles coincide, which the report asks last: in words, and in figures for each
/// pair of looks.
[[nodiscard]] std::string epipoles_sentence(const cycle::Fixation& fixation,
                                            const geometry::Rig& before);
[[nodiscard]] Table table_of_epipoles(const cycle::Fixation& fixation);

/// What was believed of the robot before and after: value and sigma.
[[nodiscard]] Table table_of_robot(const cycle::Fixation& fixation, const geometry::Rig& before);

}  // namespace gazed::lab::explain
