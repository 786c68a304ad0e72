/// @file
/// From frames to pictures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "grainreel/files.hpp"
#include "grainreel/frame.hpp"
#include "grainreel/scene.hpp"
#include "grainreel/world.hpp"

namespace grainreel::v1 {

/// Pixels: 8-bit sRGB.
struct Picture {
    int width = 0;   ///< Pixels.
    int height = 0;  ///< Pixels.
    /// Rows from the top, 4 bytes a pixel: red, green, blue, alpha (255: opaque; colours are not multiplied
    /// by it). width * height * 4 bytes.
    std::vector<std::uint8_t> rgba{};

    /// Writes a PNG. It is written under another name first, so a file of this name is never incomplete.
    /// Throws Error where it cannot be written.
    void write_png(const std::filesystem::path& file) const;
};

/// Draws frames without a screen, with an OpenGL context by OSMesa, which is loaded when it is needed. Use a
/// painter on the thread that made it; several threads may have one each. It can be moved but not copied.
///
/// `settings` are values for keys of [film], "film.size=640x480", "film.camera.azimuth=40",
/// "film.words=none", and colours, "species.big.colour=#2a6fb0". docs/reference/scenes.md has all keys.
///
/// Frames know no contacts, no measures and no displacements over a period. Settings that show these are
/// refused ("film.force_chains=true"); where a scene's own film shows them, they are left out. So
/// film.colour.by can be species, speed, vertical-velocity, start-height, spin and kinetic-energy.
/// Start-height is the height of a grain in the first frame that draw() gets, above the place of the floor
/// (Frame::bodies[1], or z = 0); grains that come later are grey.
class Painter {
  public:
    /// Takes the walls and the film of a scene; its frames come from Simulation, run() or a file. The picture
    /// contains all of the container. Throws Error where a setting is wrong, or no OpenGL context can be
    /// made.
    explicit Painter(const Scene& scene, const std::vector<std::string>& settings = {});
    /// Takes walls of your own. The picture contains the walls and the grains of `first`. If no setting
    /// "film.colour.range" says the range of colours, it follows from `first`: start heights go from 0 to its
    /// highest grain, speeds to that of a grain that is as fast as its fastest and falls from its highest.
    /// Without such a scale (all of them at rest at z <= 0) an Error asks for the range.
    Painter(const World& world, const Frame& first, const std::vector<std::string>& settings = {});
    /// For the frames of a file: takes the walls of its scene or its world. The picture contains all that its
    /// last frame has. The range of colours follows from its first frame, as above.
    explicit Painter(const FrameFile& file, const std::vector<std::string>& settings = {});
    ~Painter();
    Painter(Painter&&) noexcept;             ///< Moves.
    Painter& operator=(Painter&&) noexcept;  ///< Moves.

    /// Draws a frame, with `words` in its caption, in UTF-8. Throws Error where the frame is not as Frame
    /// says, or has a species that the scene or world does not have.
    Picture draw(const Frame& frame, const std::string& words = "");

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel::v1
