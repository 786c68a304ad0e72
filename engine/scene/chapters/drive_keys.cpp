// The keys of [drive].
#include <fmt/format.h>

#include <numbers>

#include "engine/scene/chapters/chapters.hpp"
#include "engine/scene/drive/stage_keys.hpp"
#include "engine/scene/keys/bound_key.hpp"

namespace grainreel {
namespace {

using namespace keys;

const Words<Drive::Moves> moves_words{{"container", Drive::Moves::container}, {"floor", Drive::Moves::floor}};

// Another way to say the amplitude, which is what is kept and written.
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

}  // namespace grainreel
