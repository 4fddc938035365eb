// gait label: when which foot touches, and the steps between.
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "clip_reader.h"
#include "commands.h"
#include "gait/error.h"
#include "gait/files/label_file.h"
#include "gait/motion/contacts.h"
#include "json_report.h"
#include "option_kinds.h"

namespace gait::tool {

namespace {

struct LabelOptions {
  std::vector<std::string> clips;
  std::string output;
  bool json = false;
  ClipReading reading;
};

struct LabelledClip {
  std::string path;
  int frames = 0;
  double frame_rate = 30;
  WalkTrack track;
  std::vector<Step> steps;
};

LabelledClip label_clip(const std::string& path, const ClipReading& reading) {
  const ReadClip read = read_clip(path, reading, "label");
  warn_of_roles("label", reading, read.roles_without_joint);
  LabelledClip labelled{path, read.clip.frames(), read.clip.frame_rate, {}, {}};
  labelled.track = follow_walk(read.clip, read.roles);
  labelled.steps = steps_between(labelled.track.contacts);
  if (labelled.steps.empty())
    std::fprintf(stderr, "gait label: warning: %s: no steps found\n", path.c_str());
  return labelled;
}

void print_table(const LabelledClip& clip) {
  const WalkTrack& track = clip.track;
  std::printf("%s\n", clip.path.c_str());
  std::printf("  %d frames at %.4g per second, %.2f m/s%s, cycle %.2f s, %zu contacts, %zu steps\n",
              clip.frames, clip.frame_rate, track.speed, track.treadmill ? " on a treadmill" : "",
              track.cycle_seconds, track.contacts.size(), clip.steps.size());
  if (track.contacts.empty()) return;
  std::printf("  %-6s %7s %9s %9s\n", "foot", "frame", "time/s", "step/s");
  std::size_t next = 0;  // the step that starts at this contact or later
  for (const Contact& contact : track.contacts) {
    std::printf("  %-6s %7d %9.3f", std::string(foot_name(contact.foot)).c_str(), contact.frame,
                contact.seconds(clip.frame_rate));
    while (next < clip.steps.size() && clip.steps[next].begin < contact.frame) ++next;
    if (next < clip.steps.size() && clip.steps[next].begin == contact.frame)
      std::printf(" %9.3f", (clip.steps[next].end - clip.steps[next].begin) / clip.frame_rate);
    std::printf("\n");
  }
}

nlohmann::ordered_json as_json(const LabelledClip& clip) {
  nlohmann::ordered_json contacts = nlohmann::ordered_json::array();
  for (const Contact& contact : clip.track.contacts)
    contacts.push_back({{"foot", foot_name(contact.foot)},
                        {"frame", contact.frame},
                        {"seconds", contact.seconds(clip.frame_rate)}});
  nlohmann::ordered_json steps = nlohmann::ordered_json::array();
  for (const Step& step : clip.steps)
    steps.push_back({{"foot", foot_name(step.foot)},
                     {"begin", step.begin},
                     {"end", step.end},
                     {"seconds", (step.end - step.begin) / clip.frame_rate}});
  return {{"clip", clip.path},
          {"frames", clip.frames},
          {"frame_rate", clip.frame_rate},
          {"speed", clip.track.speed},
          {"treadmill", clip.track.treadmill},
          {"cycle_seconds", clip.track.cycle_seconds},
          {"leg_length", clip.track.leg_length},
          {"contacts", contacts},
          {"steps", steps}};
}

// Audacity's form, unless the name asks for HTK's.
LabelForm form_of(const std::filesystem::path& path) {
  return path.extension() == ".lab" ? LabelForm::htk : LabelForm::audacity;
}

void write(const LabelledClip& clip, const std::filesystem::path& output) {
  if (clip.steps.empty()) return;
  const std::filesystem::path path =
      std::filesystem::is_directory(output)
          ? output / std::filesystem::path(clip.path).stem().concat(".txt")
          : output;
  write_labels(labels_from_contacts(clip.track.contacts, clip.frame_rate), form_of(path), path);
}

void label(const LabelOptions& options) {
  if (!options.output.empty() && options.clips.size() > 1 &&
      !std::filesystem::is_directory(options.output))
    throw UsageError("-o " + options.output +
                     ": with several clips, expected a folder that exists");

  nlohmann::ordered_json report = nlohmann::ordered_json::array();
  bool found = false;
  for (const std::string& path : options.clips) {
    const LabelledClip clip = label_clip(path, options.reading);
    found = found || !clip.steps.empty();
    if (!options.output.empty()) write(clip, options.output);
    if (options.json)
      report.push_back(as_json(clip));
    else
      print_table(clip);
  }
  if (options.json) print_report(report);
  if (!found) throw Error("no steps found, nothing to label");
}

void add_options(CLI::App& app, LabelOptions& options) {
  add_argument(app, "CLIP", options.clips, "BVH files");
  add_value(app, "-o,--output", "FILE", options.output,
            "Label file to write: Audacity's form, HTK's when the name ends in .lab; for several "
            "clips a folder, one .txt for each");
  add_json_flag(app, options.json);
  add_clip_reading(app, options.reading);
  app.footer(
      R"(A contact is a foot's first touch; a step goes from one foot's contact to the other's and
bears the name of the foot that starts it.

Examples:
  gait label walk.bvh
  gait label walk.bvh -o walk.txt      open it beside the sound in Audacity
  gait label takes/*.bvh -o labels/    one label file for each)");
}

}  // namespace

Command label_command(CLI::App& program) {
  return make_command(program, "label", "Find when the feet touch, and the steps between",
                      add_options, label);
}

}  // namespace gait::tool
