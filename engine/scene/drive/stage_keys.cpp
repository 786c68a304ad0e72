#include "engine/scene/drive/stage_keys.hpp"

#include <fmt/format.h>

#include <numbers>

#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {
namespace {

using namespace keys;
using Kind = DriveStage::Kind;

const Words<Kind> kind_words{{"vibrate", Kind::vibrate}, {"taps", Kind::taps}, {"rest", Kind::rest}};

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

// Another way to say the amplitude, which is what is kept and written. Without either the acceleration stays.
BoundKey<DriveStage> g_level_key() {
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
                 "When it begins: with the first whole period then or later."),
        choice("kind", &S::kind, kind_words, initial(),
               "Of what: a vibration, single taps, or nothing that moves.")
            .owns({"interval"})
            .read_at(-3),
        quantity("frequency", &S::frequency, Dimension::frequency, positive, note("that of before"),
                 "f; a tap lasts 1/f.")
            .read_at(-2)
            .useless_for(at_rest)
            .usually(
                [](S& stage, const Scene& scene) { stage.frequency = last_motion(scene.drive).frequency; }),
        g_level_key(),
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

}  // namespace grainreel
