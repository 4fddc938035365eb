// gait enrol: a stranger's walk merged into a model.
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <optional>
#include <set>
#include <string>

#include "commands.h"
#include "gait/corpus/demo_model.h"
#include "gait/model/model_file.h"
#include "gait/motion/rest_calibration.h"
#include "gait/platform/path_text.h"
#include "gait/platform/whole_file.h"
#include "gait/teach/enrolment.h"
#include "json_report.h"
#include "option_kinds.h"
#include "progress.h"
#include "walk_files.h"

namespace gait::tool {

namespace {

constexpr double degrees_per_radian = 180 / std::numbers::pi;

struct EnrolOptions {
  std::string model, output;
  WalkReading reading;
  EnrolmentOptions enrolment;
  bool json = false;
};

std::vector<Walk> walks_to_enrol(const Model& model, const EnrolOptions& options,
                                 RoleTable& roles) {
  Progress progress("gait enrol:");
  WalksRead read = read_walks(options.reading, "enrol", [&](double share, const std::string& file) {
    progress.show(share, "reading " + file);
  });
  std::set<std::string> subjects;
  for (Walk& walk : read.walks) {
    if (!walk.subject.empty()) subjects.insert(walk.subject);
    if (options.reading.calibrate && model.body)
      walk.clip = calibrated(walk.clip, model.body->skeleton);
  }
  if (subjects.size() > 1)
    throw Error("expected clips of one person to enrol; they name " + *subjects.begin() + " and " +
                *subjects.rbegin());
  roles = read.roles;
  return std::move(read.walks);
}

void enrol_walks(const EnrolOptions& options) {
  WholeFile output(path_from_utf8(options.output));
  const Model model = model_named(options.model);
  EnrolmentOptions enrolment = options.enrolment;
  const std::vector<Walk> walks = walks_to_enrol(model, options, enrolment.roles);
  Enrolled enrolled = enrol(model, walks, enrolment);
  for (const std::string& left_out : enrolled.left_out)
    std::fprintf(stderr, "gait enrol: warning: left out: %s\n", left_out.c_str());
  // A model keeps the names of its clips, not the folders that they lay in on this machine.
  for (std::string& clip : enrolled.model.training.clips)
    clip = utf8_of(path_from_utf8(clip).filename());
  write_model(enrolled.model, output.part());
  output.keep();

  const double before = enrolled.error_before * degrees_per_radian,
               after = enrolled.error_after * degrees_per_radian;
  if (options.json) {
    print_report({{"model", options.output},
                  {"cycles", enrolled.cycles},
                  {"seconds", enrolled.seconds},
                  {"left_out", enrolled.left_out},
                  {"error_before_deg", before},
                  {"error_expected_deg", after}});
    return;
  }
  std::printf("%d straight cycles, %.1f s, merged into %s\n", enrolled.cycles, enrolled.seconds,
              model.name.c_str());
  std::printf("Joints found in cycles left out one by one: %.2f degrees off before, %.2f after\n",
              before, after);
  std::printf("%s: written; %s is as it was\n", options.output.c_str(), options.model.c_str());
}

void add_options(CLI::App& app, EnrolOptions& options) {
  add_model_argument(app, options.model);
  add_walk_reading(app, options.reading);
  add_output(app, "M.gait", options.output, "Model to write");
  add_value(app, "--seconds", "S", options.enrolment.seconds,
            "Take whole cycles, in the order of the clips, until they last so long")
      ->check(within(1, 3600))
      ->default_str("60");
  add_json_flag(app, options.json);
  app.footer(std::string(label_help) + R"(

The clips show one person, legs and all, who walks straight for two whole cycles or more; three to
seven seconds are best. What comes out knows that person. Nothing is written when cycles that are
left out one by one would be found worse than by the model as it was.

Examples:
  gait enrol walks.gait anna_1.bvh -o anna.gait
  gait enrol walks.gait anna/*.bvh --seconds 5 -o anna.gait)");
}

}  // namespace

Command enrol_command(CLI::App& program) {
  return make_command(program, "enrol", "Merge a stranger's walk into a model", add_options,
                      enrol_walks);
}

}  // namespace gait::tool
