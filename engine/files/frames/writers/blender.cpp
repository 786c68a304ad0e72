// Writes a folder for Blender (3.4 or newer). bed.bin has every frame, and the script bed.py builds the
// moving bed:
//     blender --python bed.py            (or blender -b --python bed.py -- --render 10 picture.png)

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/files/frames/state_writer.hpp"
#include "engine/files/frames/stored_world.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

// The script that builds the bed in Blender.
const char* blender_script() {
    return R"(# Builds a moving bed of grains in Blender 3.4 or newer, from bed.json and bed.bin beside this file.
#   blender --python bed.py                               opens it
#   blender -b --python bed.py -- --render 10 bed.png     renders frame 10 and ends
# Grains are instances of one sphere on the points of a mesh, which a handler moves when the frame changes.
import json
import os
import sys

import bpy
import numpy as np
from mathutils import Quaternion, Vector

here = os.path.dirname(os.path.abspath(__file__))
head = json.load(open(os.path.join(here, "bed.json")))
data = np.memmap(os.path.join(here, "bed.bin"), dtype=np.uint8, mode="r")
colours = [(0.094, 0.456, 0.807), (0.665, 0.112, 0.0), (0.0, 0.342, 0.171), (0.604, 0.191, 0.386)]


def frame_of(k):
    one = head["frames"][max(0, min(k, len(head["frames"]) - 1))]
    n, at = one["grains"], one["offset"]
    species = data[at:at + 4 * n].view(np.int32)
    rows = data[at + 8 * n:at + 24 * n].view(np.float32).reshape(n, 4)
    return one, species, rows


def material(name, colour, alpha=1.0):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1)
    shader.inputs["Roughness"].default_value = 0.5
    shader.inputs["Alpha"].default_value = alpha
    if alpha < 1:
        made.blend_method = "BLEND"
    return made


def sphere(name, colour):
    bpy.ops.mesh.primitive_uv_sphere_add(radius=1, segments=32, ring_count=16)
    ball = bpy.context.object
    ball.name = name
    bpy.ops.object.shade_smooth()
    ball.data.materials.append(material(name, colour))
    ball.hide_set(True)
    ball.hide_render = True
    return ball


def instances(name, ball):
    """A mesh of points whose geometry nodes put a sphere of the point's radius on each."""
    mesh = bpy.data.meshes.new(name)
    points = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(points)
    tree = bpy.data.node_groups.new(name, "GeometryNodeTree")
    if hasattr(tree, "interface"):  # Blender 4.0 and later
        for way in ("INPUT", "OUTPUT"):
            tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    else:
        tree.inputs.new("NodeSocketGeometry", "Geometry")
        tree.outputs.new("NodeSocketGeometry", "Geometry")
    nodes, links = tree.nodes, tree.links
    begin, end = nodes.new("NodeGroupInput"), nodes.new("NodeGroupOutput")
    info, on = nodes.new("GeometryNodeObjectInfo"), nodes.new("GeometryNodeInstanceOnPoints")
    radius = nodes.new("GeometryNodeInputNamedAttribute")
    radius.data_type = "FLOAT"
    radius.inputs["Name"].default_value = "grain_radius"
    info.inputs["Object"].default_value = ball
    links.new(begin.outputs[0], on.inputs["Points"])
    links.new(info.outputs["Geometry"], on.inputs["Instance"])
    scale = [socket for socket in radius.outputs if socket.enabled][0]
    links.new(scale, on.inputs["Scale"])
    links.new(on.outputs[0], end.inputs[0])
    points.modifiers.new("grains", "NODES").node_group = tree
    return points


for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)
beds = []
for number, name in enumerate(head["species"]):
    ball = sphere("ball " + name, colours[number % len(colours)])
    beds.append(instances(name, ball))
walls = []
for wall in head["walls"]:
    mesh = bpy.data.meshes.new(wall["name"])
    mesh.from_pydata(wall["vertices"], [], wall["triangles"])
    thing = bpy.data.objects.new(wall["name"], mesh)
    thing.rotation_mode = "QUATERNION"
    mesh.materials.append(material(wall["name"], (0.66, 0.70, 0.75)))
    mesh.materials.append(material(wall["name"] + " in front", (0.75, 0.8, 0.85), 0.06))
    bpy.context.collection.objects.link(thing)
    walls.append(thing)


def show(scene, *_):
    one, species, rows = frame_of(scene.frame_current)
    for number, bed in enumerate(beds):
        some = rows[species == number]
        mesh = bed.data
        mesh.clear_geometry()
        mesh.vertices.add(len(some))
        mesh.vertices.foreach_set("co", some[:, :3].ravel())
        attribute = mesh.attributes.get("grain_radius") or mesh.attributes.new("grain_radius", "FLOAT", "POINT")
        attribute.data.foreach_set("value", np.ascontiguousarray(some[:, 3]))
        mesh.update()
    for thing, pose in zip(walls, one["walls"]):
        thing.location = pose[:3]
        thing.rotation_quaternion = Quaternion(pose[3:])


scene = bpy.context.scene
scene.frame_start, scene.frame_end = 0, len(head["frames"]) - 1
scene.frame_set(0)
show(scene)
bpy.app.handlers.frame_change_post.append(show)

_, _, first = frame_of(0)
low = (first[:, :3] - first[:, 3:]).min(axis=0) if len(first) else np.zeros(3)
high = (first[:, :3] + first[:, 3:]).max(axis=0) if len(first) else np.ones(3)
for wall in head["walls"]:
    corners = np.array(wall["vertices"])
    low, high = np.minimum(low, corners.min(axis=0)), np.maximum(high, corners.max(axis=0))
middle, size = Vector((low + high) / 2), float(np.linalg.norm(high - low))
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.data.clip_start, camera.data.clip_end = size / 1000, size * 100
camera.location = middle + Vector((1.3, -0.5, 0.35)).normalized() * 2.8 * size  # all of the container is seen
camera.rotation_euler = (middle - camera.location).to_track_quat("-Z", "Y").to_euler()
to_camera = (camera.location - middle).normalized()
# Walls between the camera and the bed are all but clear, so that the bed is seen.
for thing, wall in zip(walls, head["walls"]):
    for face in thing.data.polygons:
        outward = face.normal if face.normal.dot(face.center - middle) > 0 else -face.normal
        face.material_index = 1 if outward.dot(to_camera) > 0.3 else 0
# A wide lamp over the viewer's left shoulder, as in the films, and a ground under the lowest wall.
lamp = bpy.data.objects.new("lamp", bpy.data.lights.new("lamp", "AREA"))
lamp.data.shape, lamp.data.size = "DISK", 0.5 * size
left = Vector((0, 0, 1)).cross(to_camera).normalized() * -1
lamp.location = middle + 2.2 * size * (0.48 * left + 0.58 * to_camera + Vector((0, 0, 0.66)))
lamp.rotation_euler = (middle - lamp.location).to_track_quat("-Z", "Y").to_euler()
lamp.data.energy = 9 * (2.2 * size) ** 2  # W: the light on the bed does not depend on its size
bpy.ops.mesh.primitive_plane_add(size=60 * size, location=(middle.x, middle.y, float(low[2]) - 1e-3 * size))
ground = bpy.context.object
ground.name = "ground"
ground.data.materials.append(material("ground", (0.8, 0.8, 0.8)))
for thing in (camera, lamp):
    bpy.context.collection.objects.link(thing)
scene.camera = camera
scene.world = scene.world or bpy.data.worlds.new("world")
scene.world.use_nodes = True
background = scene.world.node_tree.nodes.get("Background")
if background:
    background.inputs["Color"].default_value = (1, 1, 1, 1)
    background.inputs["Strength"].default_value = 0.6

words = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
if words[:1] == ["--render"]:
    scene.frame_set(int(words[1]))
    show(scene)
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 24
    scene.cycles.use_denoising = False  # Debian's Blender has none
    scene.view_settings.view_transform = "Standard"
    scene.render.resolution_x, scene.render.resolution_y = 960, 540
    scene.render.filepath = os.path.abspath(words[2])
    bpy.ops.render.render(write_still=True)
)";
}

class Blender final : public StateWriter {
  public:
    explicit Blender(const fs::path& folder) : folder_(folder) {
        std::error_code error;
        fs::create_directories(folder_, error);
        if (error) throw RunError("{}: cannot be made: {}", folder_.string(), error.message());
        out_.open(folder_ / "bed.bin", std::ios::binary | std::ios::trunc);
    }

    void begin(const StoredWorld& world, const StateSupply&) override {
        surfaces_ = surfaces_of(world);
        head_["program"] = "grainreel";
        head_["title"] = world.title;
        for (const WorldSpecies& species : world.species) head_["species"].push_back(species.name);
        head_["walls"] = nlohmann::json::array();
        for (const WorldSurface& surface : surfaces_) {
            nlohmann::json one = {{"name", surface.name},
                                  {"vertices", nlohmann::json::array()},
                                  {"triangles", surface.shape.triangles}};
            for (const Vec3& v : surface.shape.vertices) one["vertices"].push_back({v.x(), v.y(), v.z()});
            head_["walls"].push_back(one);
        }
        head_["frames"] = nlohmann::json::array();
    }
    // A frame is the species of all grains, their ids (int32), then x, y, z and radius of each grain
    // (float32). frame_of() in the script above reads this layout.
    void frame(const State& frame, const std::vector<Link>&) override {
        nlohmann::json poses = nlohmann::json::array();
        for (const WorldSurface& surface : surfaces_) {
            const BodyPose pose = frame.body(surface.body);
            poses.push_back({pose.place.x(), pose.place.y(), pose.place.z(), pose.rotation.w(),
                             pose.rotation.x(), pose.rotation.y(), pose.rotation.z()});
        }
        head_["frames"].push_back(
            {{"time", frame.time}, {"grains", frame.size()}, {"offset", place_}, {"walls", poses}});
        std::string bytes;
        const auto add = [&](const void* data, std::size_t size) {
            bytes.append(static_cast<const char*>(data), size);
        };
        add(frame.species.data(), frame.size() * sizeof(std::int32_t));
        add(frame.id.data(), frame.size() * sizeof(std::int32_t));
        for (std::size_t i = 0; i < frame.size(); ++i) {
            const Vec3& x = frame.position[i];
            const float row[4] = {static_cast<float>(x.x()), static_cast<float>(x.y()),
                                  static_cast<float>(x.z()), static_cast<float>(frame.radius[i])};
            add(row, sizeof(row));
        }
        out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        place_ += bytes.size();
        if (!out_) throw RunError("{}: cannot be written; is the disk full?", (folder_ / "bed.bin").string());
    }
    void end() override {
        out_.close();
        if (!out_) throw RunError("{}: cannot be written; is the disk full?", (folder_ / "bed.bin").string());
        TextFile(folder_ / "bed.json").write(head_.dump());
        TextFile(folder_ / "bed.py").write(blender_script());
    }

  private:
    fs::path folder_;
    std::ofstream out_;
    nlohmann::json head_;
    std::vector<WorldSurface> surfaces_;
    std::uint64_t place_ = 0;
};

}  // namespace

WriteFormat blender_format() {
    return {"blender", "folder for Blender: all frames, and a script that builds the moving bed", "-blender",
            make_writer<Blender>};
}

}  // namespace grainreel
