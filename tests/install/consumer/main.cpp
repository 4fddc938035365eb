// Walks by an installed model: consumer MODEL. Says in which styles, and how far a thigh swings.
#include <gait/error.h>
#include <gait/model/model_file.h>
#include <gait/play/cycles/style_walker.h>
#include <gait/play/play_model.h>

#include <algorithm>
#include <cstdio>
#ifdef HAS_OSC
#include <gait/osc/receiver.h>
#endif

int main(int count, char** arguments) try {
  if (count != 2) return 2;
  const auto played = gait::make_play_model(gait::read_model(arguments[1]));
  gait::StyleWalker walker(*played, 1);
  float least = 9, most = -9, longest = 0;
  for (int frame = 0; frame < 300; ++frame) {
    if (!walker.advance(1.0 / 30)) return 1;
    for (const Eigen::Quaternionf& rotation : walker.pose()) {
      longest = std::max(longest, std::abs(rotation.norm() - 1));
      least = std::min(least, rotation.x());
      most = std::max(most, rotation.x());
    }
  }
#ifdef HAS_OSC
  const gait::osc::Receiver receiver({.port = 0});
  if (receiver.port() <= 0) return 1;
#endif
  std::printf("styles %zu swing %.3f off %.6f\n", played->model->styles.size(),
              static_cast<double>(most - least), static_cast<double>(longest));
  return most - least > 0.2f && longest < 1e-4f ? 0 : 1;
} catch (const gait::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
