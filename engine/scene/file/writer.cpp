#include "engine/scene/file/writer.hpp"

#include "engine/scene/chapters/chapters.hpp"

namespace grainreel {

std::string written_scene(const Scene& scene, const Reasons& reasons) {
    SceneText out;
    out.comment("Every value as it was used, in SI units; phases in turns, the camera in degrees.");
    write_top_level(out, scene);
    write_species(out, scene);
    write_contact(out, scene, reasons);
    write_container(out, scene);
    write_walls(out, scene);
    write_meshes(out, scene);
    write_exits(out, scene);
    write_grains(out, scene);
    write_feeds(out, scene);
    write_drive(out, scene);
    write_start(out, scene);
    write_run(out, scene, reasons);
    return out.take() + scene.film_text;
}

}  // namespace grainreel
