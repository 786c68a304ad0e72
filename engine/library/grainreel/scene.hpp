/// @file
/// What is to be run: a scene that was read, with the step and the stiffness that were chosen for it (its
/// plan).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "grainreel/version.hpp"

namespace grainreel::v1 {

/// The numbers of one kind of contact, as the plan chose them or the scene said them.
struct ContactNumbers {
    double stiffness = 0;       ///< N/m while loading; for Hertz' law at the allowed overlap.
    double restitution = 1;     ///< At the expected speed of impact.
    double friction = 0;        ///< Coulomb's coefficient.
    double effective_mass = 0;  ///< kg, of the lightest pair.
    double contact_time = 0;    ///< s, how long a free impact lasts.
};

/// A scene that can be run as it is. A Scene never changes, so copies share its data and are cheap. The keys
/// of scene files are in docs/reference/scenes.md of the program.
class Scene {
  public:
    /// Reads a scene file. If there is no such file, reads the scene of that name that is shipped with the
    /// program ("wedge_segregation"). `settings` take precedence over the file: "run.duration=2 s",
    /// "species.big.count=30". A setting removes a key of the file that it excludes (drive.amplitude removes
    /// drive.g_level); of two settings to one key the later one counts. Throws Error at the first mistake,
    /// with file, line and column, or with "setting KEY" in their place; two settings that exclude each other
    /// are one.
    static Scene from_file(const std::filesystem::path& file, const std::vector<std::string>& settings = {});
    /// The same from text. `file` is its name in messages, and paths in the scene are relative to its folder.
    static Scene from_text(std::string_view text, const std::filesystem::path& file = "scene.toml",
                           const std::vector<std::string>& settings = {});

    std::string name() const;                   ///< The file's stem.
    std::string title() const;                  ///< As the scene says; may be empty.
    std::vector<std::string> species() const;   ///< Names; a grain's species is an index into this list.
    std::int64_t grains() const;                ///< Those at the start and all that come later.
    double duration() const;                    ///< s, from the start of the drive.
    double step() const;                        ///< s, of one time step.
    std::int64_t steps() const;                 ///< Steps in the whole duration.
    double period() const;                      ///< s, of the drive; 0 without one.
    std::vector<std::string> walls() const;     ///< Names; wall w is -1 - w in Contact::second.
    std::vector<std::string> warnings() const;  ///< What can be run but may be a mistake; one line for each.

    /// The contact between two species. If `second` is empty, "walls" or "wall", the contact between `first`
    /// and the walls that are not meshes. Throws Error where there is no such species.
    ContactNumbers contact(const std::string& first, const std::string& second = "") const;

    /// The scene as TOML, with all values that the program chose.
    std::string resolved() const;

    /// Internal.
    struct Impl;
    /// Internal.
    explicit Scene(std::shared_ptr<const Impl> impl);
    /// Internal.
    const Impl& impl() const { return *impl_; }

  private:
    std::shared_ptr<const Impl> impl_;
};

}  // namespace grainreel::v1
