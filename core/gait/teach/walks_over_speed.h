// Which of a model's walks are walks over speed, and the spaces that the speed walker needs.
#pragma once

#include <vector>

#include "gait/learn/speed_space.h"
#include "gait/learn/walk_sequences.h"
#include "gait/model/model.h"

namespace gait {

// A walk in a style differs in more than speed. Walks over speed are those without a style, or in
// one called neutral, normal or standing.
std::vector<Walk> walks_over_speed(const std::vector<Walk>& walks);

// Gives a model of a body its speed spaces. Where no subject walked at speeds that differ by a
// quarter there is nothing to learn, and the model stays without.
void add_speed_spaces(Model& model, const std::vector<Walk>& walks,
                      const SpeedOptions& options = {});

}  // namespace gait
