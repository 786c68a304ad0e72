// How large the vessel is in the pictures of scenes, at several sizes of the picture.
//
//   framing SCENE... [--sizes WIDTHxHEIGHT,...]
//
// Plans the layout of each scene without running it, and prints a line of CSV for each picture: whether
// numbers and plots stand below; the letters' size; the shares of the picture that the port has, and that the
// vessel takes; whether words cut the vessel off above; the free share of the height below it; pixels a
// metre; what is left out. The table in docs/notes/rendering.md comes from it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "engine/measure/columns.hpp"
#include "render/picture/words/layout.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/draw/seen_box.hpp"

using namespace grainreel;

namespace {

void print(const std::string& file, const std::string& size) {
    const FilmedScene scene = read_filmed_scene(file, {"film.size=" + size}, measurable_in);
    const PictureLayout layout = plan_layout(scene);
    const test::SeenBox box = test::seen_box(scene, layout);
    const double wide = scene.film.width, tall = scene.film.height;
    std::cout << fmt::format(
        "{},{},{},{:.1f},{:.2f},{:.2f},{:.2f},{:.2f},{:.2f},{:.2f},{},{:.2f},{:.0f},{}\n",
        file.substr(file.rfind('/') + 1), size, layout.stacked ? 1 : 0, layout.type.main,
        layout.port.width / wide, layout.port.height / tall, box.width, box.height,
        std::max(box.width, box.height), box.area(), box.cut_by_words ? 1 : 0, box.below,
        framed_scale(scene, layout), fmt::join(layout.left_out, "; "));
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> scenes;
    std::string sizes = "854x480,640x360,640x480,640x640,1080x1080,720x1280";
    for (int i = 1; i < argc; ++i) {
        if (std::string(argv[i]) == "--sizes" && i + 1 < argc)
            sizes = argv[++i];
        else
            scenes.emplace_back(argv[i]);
    }
    std::cout << "scene,size,stacked,letters,port_w,port_h,box_w,box_h,larger,area,cut_by_words,below,scale,"
                 "left_out\n";
    for (const std::string& file : scenes) {
        std::istringstream each(sizes);
        for (std::string size; std::getline(each, size, ',');) print(file, size);
    }
}
