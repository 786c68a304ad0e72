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

    /// Writes a PNG, under another name first, so that a file with the name is whole. Throws Error where it
    /// cannot be written.
    void write_png(const std::filesystem::path& file) const;
};

/// Draws frames, without a screen: it makes an OpenGL context by OSMesa, which is opened when it is needed.
/// Use one on the thread that made it; several threads may have one each. Can be moved, not copied.
///
/// `settings` are keys of [film], "film.size=640x480", "film.camera.azimuth=40", "film.words=none",
/// and colours, "species.big.colour=#2a6fb0"; docs/reference/scenes.md has all of them.
class Painter {
  public:
    /// With the walls and the film of a scene; its frames come from Simulation, run() or a file. The camera
    /// has all of the container in the picture. Throws Error where a setting is wrong, or no context is to be
    /// had.
    explicit Painter(const Scene& scene, const std::vector<std::string>& settings = {});
    /// With walls of one's own. The camera has the walls and the grains of `first` in the picture.
    Painter(const World& world, const Frame& first, const std::vector<std::string>& settings = {});
    /// As a file's frames are to be drawn: with the walls of its scene or its world, framed for its last
    /// frame.
    explicit Painter(const FrameFile& file, const std::vector<std::string>& settings = {});
    ~Painter();
    Painter(Painter&&) noexcept;             ///< Moves.
    Painter& operator=(Painter&&) noexcept;  ///< Moves.

    /// Draws a frame; `words` stand in its caption. Throws Error where it is no frame, or has a species that
    /// the scene or world has not.
    Picture draw(const Frame& frame, const std::string& words = "");

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel::v1
