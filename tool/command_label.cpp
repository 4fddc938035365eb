// gait label: when which foot touches, and the steps between.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "clip_reader.h"
#include "commands.h"
#include "gait/error.h"
#include "gait/files/label_file.h"
#include "gait/motion/contacts.h"
#include "gait/platform/path_text.h"
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
  int frames = 0;  // rows of the file, in which contacts are counted
  double frame_rate = 30;
  bool walks = true, loop = false;
  WalkTrack track;
  std::vector<Step> steps;
  std::vector<ClipDoubt> doubts;
};

LabelledClip label_clip(const std::filesystem::path& path, const ClipReading& reading) {
  ReadClip read = read_clip(path, reading);
  warn_of_roles("label", reading, read.roles_without_joint);
  // Without legs: says what is missing.
  if (!read.track) read.track = follow_walk(read.clip, read.roles);
  LabelledClip labelled;
  labelled.path = utf8_of(path);
  labelled.frames = static_cast<int>(read.file.values.rows());
  labelled.frame_rate = read.clip.frame_rate;
  labelled.track = std::move(*read.track);
  for (Contact& contact : labelled.track.contacts) contact.frame += read.first_row;
  labelled.steps = steps_between(labelled.track.contacts);
  labelled.loop = read.loop;
  labelled.doubts = std::move(read.doubts);
  labelled.walks =
      std::none_of(labelled.doubts.begin(), labelled.doubts.end(),
                   [](const ClipDoubt& doubt) { return doubt.concern == Concern::not_walking; });
  if (labelled.steps.empty())
    labelled.doubts.push_back({Concern::not_walking, labelled.path + ": no steps found"});
  return labelled;
}

void print_table(const LabelledClip& clip) {
  const WalkTrack& track = clip.track;
  std::printf("%s\n", clip.path.c_str());
  std::printf("  %d frames at %.4g per second, ", clip.frames, clip.frame_rate);
  if (clip.walks)
    std::printf("%.2f m/s%s, cycle %.2f s, ", track.speed, track.treadmill ? " on a treadmill" : "",
                track.cycle_seconds);
  else
    std::printf("does not look like walking, ");
  std::printf("%s%zu contacts, %zu steps\n", clip.loop ? "a loop, " : "", track.contacts.size(),
              clip.steps.size());
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
  nlohmann::ordered_json doubts = nlohmann::ordered_json::array();
  for (const ClipDoubt& doubt : clip.doubts)
    doubts.push_back({{"about", concern_named(doubt.concern)}, {"text", doubt.text}});
  return {{"clip", clip.path},
          {"frames", clip.frames},
          {"frame_rate", clip.frame_rate},
          {"walking", clip.walks},
          {"loop", clip.loop},
          {"doubts", doubts},
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
  const std::filesystem::path path = std::filesystem::is_directory(output)
                                         ? output / path_from_utf8(clip.path).stem().concat(".txt")
                                         : output;
  write_labels(labels_from_contacts(clip.track.contacts, clip.frame_rate), form_of(path), path);
}

// Two clips must not write one label file.
void check_output(const LabelOptions& options, const std::vector<std::filesystem::path>& clips) {
  if (options.output.empty() || clips.size() < 2) return;
  if (!std::filesystem::is_directory(path_from_utf8(options.output)))
    throw UsageError("-o " + options.output +
                     ": with several clips, expected a folder that exists");
  std::map<std::filesystem::path, std::filesystem::path> by_name;
  for (const auto& clip : clips)
    if (const auto [other, is_new] = by_name.emplace(clip.stem(), clip); !is_new)
      throw UsageError("-o " + options.output + ": expected clips of different names, found " +
                       utf8_of(other->second) + " and " + utf8_of(clip));
}

// All that is doubtful in many clips, the worst first.
void print_summary(std::vector<ClipDoubt> doubts, std::size_t clips) {
  constexpr int most_told = 20;  // of one concern
  std::printf("\n%zu clips, %s\n", clips,
              doubts.empty() ? "none in doubt" : "in doubt, worst first:");
  std::stable_sort(doubts.begin(), doubts.end(),
                   [](const ClipDoubt& a, const ClipDoubt& b) { return a.concern < b.concern; });
  for (auto doubt = doubts.begin(); doubt != doubts.end();) {
    const auto end = std::find_if(doubt, doubts.end(), [&](const ClipDoubt& other) {
      return other.concern != doubt->concern;
    });
    std::printf("  %s (%td)\n", std::string(concern_named(doubt->concern)).c_str(), end - doubt);
    for (int told = 0; told < most_told && doubt != end; ++told, ++doubt)
      std::printf("    %s\n", doubt->text.c_str());
    if (doubt != end) std::printf("    and %td more\n", end - doubt);
    doubt = end;
  }
}

void label(const LabelOptions& options) {
  const std::vector<std::filesystem::path> clips = clips_below(options.clips);
  check_output(options, clips);
  const bool several = clips.size() > 1;
  nlohmann::ordered_json report = nlohmann::ordered_json::array();
  std::vector<ClipDoubt> doubts;
  bool found = false;
  int refused = 0;
  for (const std::filesystem::path& path : clips) {
    LabelledClip clip;
    try {
      clip = label_clip(path, options.reading);
    } catch (const Error& error) {
      // One clip of many does not keep the others from being labelled.
      if (!several) throw;
      doubts.push_back({Concern::refused, error.what()});
      ++refused;
      if (options.json) print_warnings("label", {std::string("refused: ") + error.what()});
      continue;
    }
    found = found || !clip.steps.empty();
    if (!several || options.json)
      for (const ClipDoubt& doubt : clip.doubts) print_warnings("label", {doubt.text});
    if (!options.output.empty()) write(clip, path_from_utf8(options.output));
    if (options.json)
      report.push_back(as_json(clip));
    else
      print_table(clip);
    doubts.insert(doubts.end(), clip.doubts.begin(), clip.doubts.end());
  }
  if (options.json)
    print_report(report);
  else if (several)
    print_summary(std::move(doubts), clips.size());
  if (refused > 0)
    throw Error(std::to_string(refused) + " of " + std::to_string(clips.size()) +
                " clips were refused");
  if (!found) throw Error("no steps found, nothing to label");
}

void add_options(CLI::App& app, LabelOptions& options) {
  add_argument(app, "CLIP", options.clips, "BVH files, or folders with some");
  add_value(app, "-o,--output", "FILE", options.output,
            "Label file to write: Audacity's form, HTK's when the name ends in .lab; for several "
            "clips a folder, one .txt for each");
  add_json_flag(app, options.json);
  add_clip_reading(app, options.reading);
  app.footer(
      R"(A contact is a foot's first touch; a step goes from one foot's contact to the other's and
bears the name of the foot that starts it. Several clips end with one summary of what is in doubt,
the worst first.

Examples:
  gait label walk.bvh
  gait label walk.bvh -o walk.txt      open it beside the sound in Audacity
  gait label takes/ -o labels/         one label file for each)");
}

}  // namespace

Command label_command(CLI::App& program) {
  return make_command(program, "label", "Find when the feet touch, and the steps between",
                      add_options, label);
}

}  // namespace gait::tool
