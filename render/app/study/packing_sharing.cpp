#include "render/app/study/packing_sharing.hpp"

#include <fmt/format.h>

#include "engine/run/simulation/simulation.hpp"
#include "engine/scene/scene_file.hpp"

namespace grainreel {

namespace {

std::string text_without_drive(Scene scene) {
    scene.drive = {};
    scene.title.clear();
    scene.film_text.clear();
    scene.output = {};
    scene.run.duration = 1;
    return written_scene(scene);
}

}  // namespace

void PackingSharing::add_setting(const Scene& scene, const Plan& plan) {
    if (settings_ == kMost) return;
    ++settings_;
    if (!scene.start.packs()) return;
    const std::string key = Simulation(scene, plan, 1).packing_key();
    if (key.empty()) return;
    ++packing_;
    packings_.insert(key);
    without_drive_.insert(text_without_drive(scene));
    grows_ = grows_ || scene.start.method == Start::Method::layers;
}

std::string PackingSharing::text() const {
    if (packing_ < 2) return "";
    if (packings_.size() < packing_)
        return fmt::format(
            "{} settings begin with {} different packings for each seed; each is made once, if it "
            "takes longer than a second, and found by those that start later",
            packing_, packings_.size());
    if (without_drive_.size() == packing_) return "";
    return grows_ ? "settings that differ in the drive share no packing, since radii grow while it moves; "
                    "start.method = \"rain\", with contact.stiffness and run.step given, shares one"
                  : "settings that differ in the drive share no packing, since stiffness and step follow the "
                    "drive; give contact.stiffness and run.step, and one packing serves all";
}

}  // namespace grainreel
