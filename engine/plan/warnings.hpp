// The list of warnings of a plan: lines for the user, each with its place in the scene. Internal to
// make_plan.
#pragma once

#include <fmt/format.h>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/scene.hpp"

namespace grainreel {

// The warning of so many grains (`all` in total, known or about) that leave through exits when the drive
// starts.
std::string exit_warning(const Scene& scene, double leave, std::int64_t all, bool known);

class Warnings {
  public:
    explicit Warnings(const Scene& scene) : scene_(scene) {}
    void add(const std::string& key, const std::string& what) {
        lines_.push_back(fmt::format("{}: {}", scene_.where(key), what));
    }
    std::vector<std::string> take() { return std::move(lines_); }

  private:
    const Scene& scene_;
    std::vector<std::string> lines_;
};

}  // namespace grainreel
