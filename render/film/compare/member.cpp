#include "render/film/compare/member.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/system/program.hpp"
#include "engine/base/team.hpp"
#include "engine/base/text.hpp"
#include "engine/measure/columns.hpp"
#include "engine/run/driver/also_exports.hpp"
#include "engine/scene/scene_file.hpp"
#include "engine/scene/text/toml_text.hpp"
#include "render/film/compare/comparison.hpp"
#include "render/film/compare/comparison_words.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

ComparedMember::ComparedMember(const FilmedScene& scene, const Plan& plan, int threads)
    : driver_(std::make_unique<RunDriver>(scene, plan, threads)),
      source_(std::make_unique<LiveShots>(scene, *driver_)) {
    check_also(scene);
}

std::string ComparedMember::place() const {
    return driver_ ? scene().name : std::filesystem::absolute(archive()->path()).string();
}

void ComparedMember::begin(const std::filesystem::path& folder, const JobRequest& request) {
    if (!driver_) return;
    const std::filesystem::path own = folder / place();
    std::error_code error;
    std::filesystem::create_directory(own, error);
    if (error) throw RunError("{}: cannot be made: {}", own.string(), error.message());
    std::optional<FolderLock> lock = FolderLock::take(own, request.command);
    if (!lock) throw RunError("{}: another process has it", own.string());
    driver_->use_folder(folder_.emplace(std::move(*lock)), request.program.version);
    if (request.keep_packings) driver_->keep_packings(*request.keep_packings);
    static_cast<ProgramInfo&>(report_) = request.program;
    report_.command = request.command;
    report_.started = utc_now();
    driver_->describe(report_);
    report_.warnings = driver_->plan().warnings;
    write_run_json(folder_->folder() / "run.json", report_);
}

bool ComparedMember::pack(const GoOn& go_on) {
    if (!driver_) return true;
    const bool packed = driver_->pack([&](const PackingProgress& now) {
        done_ = (now.stage == PackingProgress::Stage::settling ? 0.5 : 0.0) + 0.5 * now.done;
        return go_on();
    });
    done_ = 1;
    return packed && go_on();
}

void ComparedMember::start(const Pictures& pictures) {
    done_ = 0;
    source_->start(pictures);
}

// Progress is noted on the thread that runs the scene and read on another.
ShotPtr ComparedMember::next(const GoOn& go_on) {
    const auto noting = [&] {
        if (driver_) {
            done_ = driver_->done();
            speed_ = driver_->recent_speed();
        }
        return go_on();
    };
    std::optional<Taken> picture = source_->next(noting);
    return picture ? std::move(picture->frame) : nullptr;
}

std::vector<std::string> ComparedMember::news() const {
    std::vector<std::string> lines = source_->news();
    if (!driver_) return lines;
    if (auto warning = driver_->overlap_warning()) lines.push_back(std::move(*warning));
    return lines;
}

void ComparedMember::keep_state() {
    if (folder_ && folder_->follow()) driver_->close(failed_);
}

void ComparedMember::write_other_formats(const std::function<bool(const std::string&, double)>& watcher) {
    if (!folder_ || !folder_->is_there() || !driver_->has_other_formats()) return;
    failed_.attempt([&] { write_also(folder_->folder(), driver_->scene(), watcher); });
}

void ComparedMember::close(RunStatus status, int exit_status, FirstFailure& failure) {
    if (!folder_ || !folder_->is_there()) return;
    driver_->conclude(report_);
    report_.warnings = driver_->plan().warnings;
    for (std::string& line : news()) report_.warnings.push_back(std::move(line));
    report_.status = failed_.any()                 ? RunStatus::failed
                     : status == RunStatus::failed ? RunStatus::interrupted
                                                   : status;
    report_.exit_status = failed_.any() ? 1 : exit_status;
    report_.error = failed_.what();
    report_.finished = utc_now();
    report_.wall_seconds = driver_->times().all();
    failed_.attempt([&] { write_run_json(folder_->folder() / "run.json", report_); });
    if (failed_.any()) failure.note(failed_.what());
}

// From here on: reading the members. They are scenes to run and runs on disk, or one scene with several
// values of a key.

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_panels = 6;  // with more, each is too small to show anything

// What one panel is made from.
struct Input {
    fs::path path;
    std::optional<Assignment> value = std::nullopt;  // value of the varied key in this panel
    bool is_run() const { return is_folder(path); }
    Assignments sets(const CompareRequest& what) const {
        Assignments all = what.sets;
        if (value) all.push_back(*value);
        return all;
    }
};

// Refuses pipes: a pipe gives its scene once, but scenes may be read twice.
void check_not_pipe(const fs::path& input) {
    if (other_than_file(input, true) == "a pipe")
        throw UserError("{}: this is a pipe; give the path of a scene file (.toml)", input.string());
}

void check_count(std::size_t count, const CompareRequest& what) {
    if (what.vary && count > most_panels)
        throw UserError("--vary: has {} values; a film shows {} at most", count, most_panels);
    if (count < 2 || count > most_panels)
        throw UserError("compare takes 2 to {} scenes or folders of runs, not {}{}; see {} compare --help",
                        most_panels, count, count == 1 ? " (or one with --vary KEY=VALUE,VALUE)" : "",
                        program_call());
}

std::vector<Input> inputs_of(const CompareRequest& what) {
    std::vector<Input> inputs;
    if (!what.vary) {
        for (const fs::path& path : what.inputs) inputs.push_back({path});
    } else if (what.inputs.size() != 1) {
        throw UserError("--vary: takes one scene, not {}; give its values in it, or leave it out",
                        what.inputs.size());
    } else {
        for (Assignment& value : read_vary(*what.vary)) inputs.push_back({what.inputs[0], std::move(value)});
    }
    check_count(inputs.size(), what);
    return inputs;
}

void check_not_set_too(const CompareRequest& what, const std::vector<Input>& inputs) {
    for (const Assignment& set : what.sets)
        if (inputs[0].value && set.key() == inputs[0].value->key())
            throw UserError("{}: {} gives it a value too; leave one of the two out", inputs[0].value->place(),
                            set.place());
}

// Gives scenes different names, since each has its own folder inside the folder of the comparison.
void number_names(std::vector<FilmedScene>& scenes) {
    std::set<std::string> taken{"frames"};
    for (FilmedScene& scene : scenes) {
        const std::string name = scene.name;
        for (int number = 2; !taken.insert(scene.name).second; ++number)
            scene.name = fmt::format("{}-{}", name, number);
    }
}

// Whether a caption holds for any value of a key: it asks, or it tells the run's own numbers.
bool holds_for_all(const FilmCaption& caption) {
    return trimmed(caption.text, " \n").ends_with('?') || has_values(caption.words);
}

// If a key of a scene is varied, the captions without those that state something, which were written for the
// value in the scene file. None where all hold, or where the command line gives captions.
std::optional<Assignment> captions_for_all(const CompareRequest& what, const Input& input,
                                           const FilmedScene& scene) {
    const bool given = std::any_of(what.sets.begin(), what.sets.end(), [](const Assignment& set) {
        return set.key().rfind("film.caption", 0) == 0;
    });
    if (given || !input.value || !changes_the_scene(*input.value)) return std::nullopt;
    std::vector<std::string> kept;
    for (const FilmCaption& one : scene.film.captions) {
        if (!holds_for_all(one)) continue;
        const std::string to =
            one.to < scene.run.duration ? fmt::format(", to = {}", toml_number(one.to)) : "";
        const std::string hold = one.hold > 0 ? fmt::format(", hold = {}", toml_number(one.hold)) : "";
        kept.push_back(
            fmt::format("{{from = {}{}{}, text = {}}}", toml_number(one.from), to, hold, quoted(one.text)));
    }
    if (kept.size() == scene.film.captions.size()) return std::nullopt;
    return Assignment("film.caption=" + toml_list(kept));
}

std::vector<FilmedScene> read_scenes(const CompareRequest& what, const std::vector<Input>& inputs,
                                     const Assignments& more, std::vector<std::string>& warnings) {
    std::vector<FilmedScene> scenes;
    for (const Input& input : inputs) {
        if (input.is_run()) continue;
        check_not_pipe(input.path);
        Assignments sets = input.sets(what);
        sets.insert(sets.end(), more.begin(), more.end());
        scenes.push_back(read_filmed_scene(input.path, sets, measurable_in));
        if (const auto captions = captions_for_all(what, input, scenes.back())) {
            sets.push_back(*captions);
            scenes.back() = read_filmed_scene(input.path, sets, measurable_in);
            std::string line = fmt::format(
                "film.caption: captions that state something were written for one value of {} and are left "
                "out, those that ask or tell the run's numbers stay; --set film.caption=[...] gives the "
                "comparison its own",
                input.value->key());
            if (std::find(warnings.begin(), warnings.end(), line) == warnings.end())
                warnings.push_back(std::move(line));
        }
        if (input.value) scenes.back().name = name_with(scenes.back().name, *input.value);
    }
    number_names(scenes);
    return scenes;
}

// Reads the scenes. All end when the shortest one ends, and their films' segments are shortened to fit.
std::vector<FilmedScene> read_scenes_of_one_length(const CompareRequest& what,
                                                   const std::vector<Input>& inputs,
                                                   std::vector<std::string>& warnings) {
    std::vector<FilmedScene> scenes = read_scenes(what, inputs, {}, warnings);
    if (scenes.empty()) return scenes;
    const auto by_duration = [](const FilmedScene& a, const FilmedScene& b) {
        return a.run.duration < b.run.duration;
    };
    const auto [shortest, longest] = std::minmax_element(scenes.begin(), scenes.end(), by_duration);
    if (shortest->run.duration == longest->run.duration) return scenes;
    warnings.push_back(fmt::format("{} lasts {:.6g} s, {} {:.6g} s: all are run and shown for {:.6g} s",
                                   shortest->file, shortest->run.duration, longest->file,
                                   longest->run.duration, shortest->run.duration));
    return read_scenes(what, inputs, {fmt::format("run.duration={}", shortest->run.duration)}, warnings);
}

void check_start(const FilmedScene& scene) {
    if (scene.start.keep_clock)
        throw UserError(
            "{}: goes on at the clock of its start file, but scenes that are compared "
            "all begin at 0; remove 'keep_clock'",
            scene.where("start.keep_clock"));
}

ThreadPlan plan_threads_for(const std::vector<FilmedScene>& scenes) {
    if (scenes.empty()) return drawing_threads(0);
    const int asked = scenes.front().run.threads;
    const int processors = asked > 0 ? asked : usable_processors();
    std::int64_t grains = 0;
    for (const FilmedScene& scene : scenes) grains += scene.grains();
    ThreadPlan threads = plan_threads(processors, true, grains);
    threads.engine = std::max(1, threads.engine / static_cast<int>(scenes.size()));  // threads for each scene
    return threads;
}

std::unique_ptr<ComparedMember> member_of_run(const CompareRequest& what, const Input& input, int sharers) {
    auto record = std::make_unique<StoredShots>(input.path, input.sets(what), what.replay, sharers);
    record->check_all();
    return std::make_unique<ComparedMember>(std::move(record));
}

}  // namespace

void read_members(const CompareRequest& what, Comparison& all) {
    const std::vector<Input> inputs = inputs_of(what);
    check_not_set_too(what, inputs);
    const std::vector<FilmedScene> scenes = read_scenes_of_one_length(what, inputs, all.warnings);
    all.threads = plan_threads_for(scenes);
    std::size_t next = 0;
    std::set<std::string> said;
    const auto say = [&](const std::vector<std::string>& lines) {
        for (const std::string& line : lines)
            if (!what.vary || said.insert(line).second) all.warnings.push_back(line);
    };
    for (const Input& input : inputs) {
        if (input.is_run()) {
            all.members.push_back(member_of_run(what, input, static_cast<int>(inputs.size())));
            say(all.members.back()->source().news());
            continue;
        }
        const FilmedScene& scene = scenes[next++];
        check_start(scene);
        const Plan plan = plan_with_film(scene);
        say(plan.warnings);
        all.members.push_back(std::make_unique<ComparedMember>(scene, plan, all.threads.engine));
    }
    if (!what.vary) return;
    std::vector<Assignment> values;
    std::vector<FilmedScene> varied;
    for (const Input& input : inputs) values.push_back(*input.value);
    for (const auto& member : all.members) varied.push_back(member->scene());
    all.labels = labels_of(values, varied);
}

}  // namespace grainreel
