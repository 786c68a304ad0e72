// The keys of [drive].
#include "engine/scene/chapters/drive_keys.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <numbers>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"
#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/drive_schedule.hpp"
#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {

namespace {

using namespace keys;

const ChoiceWords<Drive::Moves> moves_words{{"container", Drive::Moves::container},
                                            {"floor", Drive::Moves::floor}};

// Another way to give the amplitude; the amplitude is kept and written.
BoundKey<Drive> g_level_key() {
    const auto read = [](Document& document, const Scene& scene, const std::string& path, Drive& drive) {
        const double omega = 2 * std::numbers::pi * drive.frequency, gravity = scene.gravity.norm();
        drive.amplitude = document.required_quantity(path) * gravity / (omega * omega);
        if (gravity == 0) document.fail(path, "means nothing without gravity; give 'amplitude' instead");
    };
    return bound_by<Drive>(quantity("g_level", Dimension::number, {0, 1e6, true, false},
                                    note("required, or `amplitude`"), "Γ = a (2πf)² / g."),
                           read, [](const Drive&, const Scene&) { return std::string(); })
        .excludes({"amplitude"})
        .useless_for(
            [](const Drive& drive) { return drive.amplitude > 0 ? "'amplitude' is given" : nullptr; });
}

const KeyTable<Drive>& drive_table() {
    using D = Drive;
    static const KeyTable<D> table{
        quantity("frequency", &D::frequency, Dimension::frequency, positive, required(), "f.").read_at(-2),
        g_level_key(),
        quantity("amplitude", &D::amplitude, Dimension::length, positive_or_tiny, note("from `g_level`"),
                 "a, half of the stroke.")
            .read_at(-1),
        vector("direction", &D::direction, Dimension::number, initial(), "Of the motion; any length."),
        quantity("phase", &D::phase, Dimension::phase, any, initial(),
                 "Of the sine at t = 0, \"90 deg\" or 0.25 turns; beyond one turn with a unit only."),
        quantity("ramp", &D::ramp, Dimension::number, not_negative, initial(),
                 "Periods over which the amplitude grows: 3 or more, or 0 for a sudden start."),
        choice("moves", &D::moves, moves_words, initial(), "What oscillates."),
    };
    return table;
}

}  // namespace

void list_drive(Keys& all) {
    drive_table().list(all, "drive");
    list_stages(all);
}

void read_drive(Document& document, Scene& scene) {
    Drive& drive = scene.drive;
    drive.present = document.has("drive");
    if (!drive.present) return;
    drive_table().read(document, scene, "drive", drive);
    make_unit(document, "drive.direction", drive.direction);
    if (drive.ramp != 0 && drive.ramp < 3)
        document.fail("drive.ramp",
                      fmt::format("must be 0 or at least 3 periods, but is {:.6g}", drive.ramp));
    read_stages(document, scene);
}

void write_drive(SceneText& out, const Scene& scene) {
    if (!scene.drive.present) return;
    out.table("drive");
    out.remark("amplitude", fmt::format("g level {:.6g}", scene.drive.g_level(scene.gravity.norm())));
    drive_table().write(out, scene, scene.drive);
    write_stages(out, scene);
}

namespace {

using namespace keys;
using Kind = DriveStage::Kind;

const ChoiceWords<Kind> kind_words{{"vibrate", Kind::vibrate}, {"taps", Kind::taps}, {"rest", Kind::rest}};

const char* at_rest(const DriveStage& stage) {
    return stage.kind == Kind::rest ? "at rest nothing oscillates" : nullptr;
}

double omega_of(double frequency) {
    return 2 * std::numbers::pi * frequency;
}

// Frequency and amplitude of the last stage that was not at rest.
struct Motion {
    double frequency, amplitude;
};
Motion last_motion(const Drive& drive) {
    for (std::size_t k = drive.stages.size(); k-- > 0;)
        if (drive.stages[k].kind != Kind::rest) return {drive.stages[k].frequency, drive.stages[k].amplitude};
    return {drive.frequency, drive.amplitude};
}

// Another way to give a stage's amplitude; the amplitude is kept and written. Without either key the stage
// keeps the acceleration of the last one.
BoundKey<DriveStage> stage_g_level_key() {
    const auto read = [](Document& document, const Scene& scene, const std::string& path, DriveStage& stage) {
        if (stage.amplitude > 0 || stage.kind == Kind::rest) return;
        const double gravity = scene.gravity.norm(), omega = omega_of(stage.frequency);
        if (const std::optional<double> level = document.quantity(path)) {
            if (gravity == 0) document.fail(path, "means nothing without gravity; give 'amplitude' instead");
            stage.amplitude = *level * gravity / (omega * omega);
            return;
        }
        const Motion before = last_motion(scene.drive);
        const double slower = before.frequency / stage.frequency;
        stage.amplitude = before.amplitude * slower * slower;
    };
    return bound_by<DriveStage>(
               quantity("g_level", Dimension::number, {0, 1e6, true, false},
                        note("that of before, unless `amplitude` is given"), "Γ = a (2πf)² / g."),
               read, [](const DriveStage&, const Scene&) { return std::string(); })
        .excludes({"amplitude"})
        .useless_for([](const DriveStage& stage) {
            return stage.amplitude > 0 ? "'amplitude' is given" : at_rest(stage);
        });
}

const KeyTable<DriveStage>& stage_table() {
    using S = DriveStage;
    static const KeyTable<S> table{
        quantity("from", &S::from, Dimension::time, not_negative, required(),
                 "When it begins: with the first whole period that starts at this time or later."),
        choice("kind", &S::kind, kind_words, initial(),
               "What the stage does: it vibrates, gives single taps, or rests.")
            .owns({"interval"})
            .read_at(-3),
        quantity("frequency", &S::frequency, Dimension::frequency, positive, note("that of before"),
                 "f; a tap lasts 1/f.")
            .read_at(-2)
            .useless_for(at_rest)
            .usually(
                [](S& stage, const Scene& scene) { stage.frequency = last_motion(scene.drive).frequency; }),
        stage_g_level_key(),
        quantity("amplitude", &S::amplitude, Dimension::length, positive_or_tiny, note("from `g_level`"),
                 "a, half of the stroke; a tap goes up by 2a and comes back.")
            .read_at(-1)
            .useless_for(at_rest),
        quantity("interval", &S::interval, Dimension::time, positive, note("required for taps"),
                 "taps: from the start of one to that of the next.")
            .needed()
            .useless_for([](const S& stage) {
                return stage.kind != Kind::taps ? "only taps have an interval" : nullptr;
            }),
        integer("over", &S::over, 3, 1000000, initial(),
                "Periods in which a vibration changes, begins or ends."),
    };
    return table;
}

DriveStage read_stage(Document& document, const Scene& scene, const std::string& table) {
    DriveStage stage;
    stage_table().read(document, scene, table, stage);
    if (stage.kind != Kind::taps) return stage;
    if (stage.interval * stage.frequency < 1 - 1e-9)
        document.fail(
            table + ".interval",
            fmt::format("is {:.6g} s, but a tap of {:.6g} Hz lasts {:.6g} s; lengthen it or raise the "
                        "frequency",
                        stage.interval, stage.frequency, 1 / stage.frequency));
    return stage;
}

}  // namespace

void list_stages(Keys& all) {
    stage_table().list(all, "drive.stage[]");
}

void read_stages(Document& document, Scene& scene) {
    for (std::size_t k = 0; k < document.size("drive.stage"); ++k)
        scene.drive.stages.push_back(read_stage(document, scene, fmt::format("drive.stage[{}]", k)));
}

void write_stages(SceneText& out, const Scene& scene) {
    for (const DriveStage& stage : scene.drive.stages) {
        out.element("drive.stage");
        const double level = stage.amplitude * omega_of(stage.frequency) * omega_of(stage.frequency);
        if (stage.kind != Kind::rest && scene.gravity.norm() > 0)
            out.remark("amplitude", fmt::format("g level {:.6g}", level / scene.gravity.norm()));
        stage_table().write(out, scene, stage);
    }
}

namespace {

constexpr double rounding = 1 + 1e-9;

[[noreturn]] void fail(const Scene& scene, std::size_t stage, const char* key, const std::string& what) {
    const std::string path = fmt::format("drive.stage[{}].{}", stage, key);
    throw UserError("{}: '{}' {}", scene.where(path), key, what);
}

void check_order(const Scene& scene) {
    const Drive& drive = scene.drive;
    for (std::size_t k = 0; k < drive.stages.size(); ++k) {
        const double from = drive.stages[k].from;
        if (k > 0 && !clearly_more(from, drive.stages[k - 1].from))
            fail(scene, k, "from",
                 fmt::format("is {:.6g} s, not later than the stage before it, {:.6g} s; stages follow each "
                             "other in time",
                             from, drive.stages[k - 1].from));
        if (!clearly_less(from, scene.run.duration))
            fail(scene, k, "from",
                 fmt::format("is {:.6g} s, but the run ends at {:.6g} s; bring it forward or lengthen "
                             "run.duration",
                             from, scene.run.duration));
    }
    const double grown = drive.ramp / drive.frequency, first = drive.stages.front().from;
    if (first > 0 && first * rounding < grown)
        fail(
            scene, 0, "from",
            fmt::format("is {:.6g} s, but until {:.6g} s the drive still grows (drive.ramp); begin later, or "
                        "at 0 in place of that drive",
                        first, grown));
}

// Checks that the change to each stage is over before the next stage begins or the run ends. A stage of taps
// must then have time left for at least one tap.
void check_lengths(const Scene& scene) {
    const std::vector<DriveStage>& stages = scene.drive.stages;
    const DriveSchedule schedule(scene.drive);
    for (std::size_t k = 0; k < stages.size(); ++k) {
        const bool last = k + 1 == stages.size();
        const double settled = schedule.settled(k + 1), end = last ? scene.run.duration : stages[k + 1].from;
        const std::string next = last ? "the run ends" : "the next stage begins";
        if (settled > end * rounding)
            fail(
                scene, k, "over",
                fmt::format("is {} periods, until {:.6g} s, but {} at {:.6g} s; change in fewer, or make the "
                            "stage longer",
                            stages[k].over, settled, next, end));
        if (stages[k].kind == DriveStage::Kind::taps && settled + 1 / stages[k].frequency > end * rounding)
            fail(scene, k, "interval",
                 fmt::format(
                     "has no time for a tap: the first would begin at {:.6g} s, and {} at {:.6g} s; make "
                     "the stage longer",
                     settled, next, end));
    }
}

// Whether the last stage begins, and the change to it is over, before the run ends. A stage of taps must also
// have time for a tap.
bool last_stage_counts(const Scene& scene) {
    const DriveStage& last = scene.drive.stages.back();
    const double end = scene.run.duration;
    if (last.from <= 0) return true;  // the stage takes the drive's place
    if (!clearly_less(last.from, end)) return false;
    const double settled = DriveSchedule(scene.drive).settled(scene.drive.stages.size());
    const double tap = last.kind == DriveStage::Kind::taps ? 1 / last.frequency : 0;
    return settled + tap <= end * rounding;
}

}  // namespace

std::size_t shorten_stages(Scene& scene) {
    std::vector<DriveStage>& stages = scene.drive.stages;
    const std::size_t before = stages.size();
    const auto in_order = [](const DriveStage& a, const DriveStage& b) { return a.from <= b.from; };
    if (!std::is_sorted(stages.begin(), stages.end(), in_order)) return 0;  // a mistake that is refused later
    while (!stages.empty() && !last_stage_counts(scene)) stages.pop_back();
    return before - stages.size();
}

void check_stages(const Scene& scene) {
    if (!scene.drive.changes()) return;
    check_order(scene);
    check_lengths(scene);
}

namespace {

bool begins_too_late(double from, const Scene& scene) {
    return !clearly_less(from, scene.run.duration);
}

// Leaves out feeds that begin too late. But if a species has no grains at the start and no feed that begins
// in time, its feeds stay, and the reader refuses them later.
void shorten_feeds(Scene& scene) {
    std::vector<bool> has_others;
    for (const Species& species : scene.species) has_others.push_back(species.count > 0);
    for (const Feed& feed : scene.feeds)
        if (!begins_too_late(feed.from, scene)) has_others[feed.species] = true;
    const auto dispensable = [&](const Feed& feed) {
        return begins_too_late(feed.from, scene) && has_others[feed.species];
    };
    leave_out(scene, std::erase_if(scene.feeds, dispensable), "feed", "feeds");
}

void shorten_outlet(Scene& scene) {
    Container& c = scene.container;
    if (!c.outlet || !begins_too_late(c.outlet->opens, scene)) return;
    c.outlet.reset();
    leave_out(scene, 1, c.tray ? "outlet and its tray" : "outlet", "");
    c.tray.reset();
}

}  // namespace

bool ends_early(const Document& document) {
    return document.from_command_line("run.duration");
}

void leave_out(Scene& scene, std::size_t count, const char* one, const char* many) {
    if (count == 0) return;
    const std::string begin = fmt::format("{}: the run ends at {:.6g} s, and goes without what comes later: ",
                                          scene.where("run.duration"), scene.run.duration);
    const std::string what = fmt::format("{} {}", count, count == 1 ? one : many);
    const auto said = std::find_if(scene.notes.begin(), scene.notes.end(),
                                   [&](const std::string& note) { return note.rfind(begin, 0) == 0; });
    if (said == scene.notes.end())
        scene.notes.push_back(begin + what);
    else
        *said += ", " + what;
}

void shorten(const Document& document, Scene& scene) {
    if (!ends_early(document)) return;
    leave_out(scene, shorten_stages(scene), "stage of the drive", "stages of the drive");
    shorten_feeds(scene);
    shorten_outlet(scene);
}

}  // namespace grainreel
