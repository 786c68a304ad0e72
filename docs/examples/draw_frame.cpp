// Draws the last frame of whatever has frames (the folder of a run, a trajectory, a final.csv, a checkpoint)
// to PNG, by what reads files and what draws:
//     draw_frame output/mine picture.png
#include <png.h>

#include <cstdio>

#include "engine/files/frames/open_frames.hpp"
#include "render/picture/whole/renderer.hpp"
#include "render/scene/plain_film.hpp"

int main(int argc, char** argv) try {
    using namespace grainreel;
    if (argc != 3) return 2;
    const auto frames = open_frames(argv[1]);
    const Frame last = frames->grains(frames->moments().size() - 1);
    FilmedScene scene = with_plain_film(frames->scene() ? *frames->scene() : scene_of(frames->world()), last);
    scene.film.width = 480;
    scene.film.height = 360;
    Renderer renderer(scene, 1);
    const Picture& picture = renderer.draw(last, "");
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = static_cast<png_uint_32>(picture.width);
    png.height = static_cast<png_uint_32>(picture.height);
    png.format = PNG_FORMAT_RGBA;
    return png_image_write_to_file(&png, argv[2], 0, picture.rgba.data(), 0, nullptr) ? 0 : 1;
} catch (const std::exception& failure) {
    std::fprintf(stderr, "%s\n", failure.what());
    return 1;
}
