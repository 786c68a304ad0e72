#include "engine/scene/keys/keys.hpp"

#include "engine/scene/chapters/chapters.hpp"

namespace grainreel {

const std::vector<Key>& scene_keys() {
    static const std::vector<Key> keys = [] {
        std::vector<Key> all;
        list_top_level(all);
        list_species(all);
        list_contact(all);
        list_container(all);
        list_walls(all);
        list_meshes(all);
        list_exits(all);
        list_grains(all);
        list_drive(all);
        list_start(all);
        list_run(all);
        list_feeds(all);
        return all;
    }();
    return keys;
}

}  // namespace grainreel
