// A patch file as it looks on the screen: which box lies where, by an estimate of Pd's font of 12
// points (7 pixels a character, 15 a line), the same on every system.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gait::testing {

struct PatchBox {
  std::string text;
  int x = 0, y = 0, width = 0, height = 0;
  bool background = false;  // a coloured canvas, upon which others lie
};

// A window: the patch itself or one of its subpatches.
struct PatchWindow {
  std::string name;
  int width = 0, height = 0;
  int font = 12;
  bool drawn = false;  // shows a part of itself in its parent: then its window is a workshop
  int drawn_width = 0, drawn_height = 0;
  std::vector<PatchBox> boxes;
};

// Throws Error naming the line when the file cannot be read.
std::vector<PatchWindow> read_patch(const std::filesystem::path& file);

// What is wrong with its looks, a line each: boxes that overlap, boxes outside their window.
std::vector<std::string> flaws(const PatchWindow& window);

}  // namespace gait::testing
