// Sequence: one take of any streams for learning: values per frame, labelled segments and a style.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace gait {

struct Segment {
  int begin = 0, end = 0;  // frames [begin, end)
  int label = 0;           // index into the labels
  double offset = 0;       // frames from `begin` to where the label begins, -1 to 0.5
};

struct Sequence {
  std::string name;
  Eigen::MatrixXd inputs, outputs;  // values by frames
  std::vector<Segment> segments;    // in order, each beginning where the one before ended
  int style = -1;                   // index into the styles, -1: none
  std::string subject{};            // who moves; empty: unknown
};

// A take as scaled observations; columns are frames [first_frame, first_frame + columns).
struct ObservedSequence {
  std::string name;
  Eigen::MatrixXd x, y;           // observation by frames
  std::vector<Segment> segments;  // frames of x and y
  int style = -1;
  int source = -1;  // index of the sequence it was observed from
};

}  // namespace gait
