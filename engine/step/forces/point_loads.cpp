// Adds the forces of single contacts with meshes and turning faces to the loads of their grains, and tallies
// them for the walls.
#include "engine/step/forces/loads.hpp"

#include "engine/step/lists/contact_rules.hpp"

namespace grainreel {

namespace {

Vec3 vector_of(const Row* rows, int c, std::size_t size) {
    return {rows[0].get(c, size), rows[1].get(c, size), rows[2].get(c, size)};
}

}  // namespace

// The force acts on the wall at the point of its surface. The torque of the resistance to rolling is added.
void add_at_point(const WallLoads& in, bool of_meshes, int c) {
    const ChunkOfContacts& chunk = in.contacts;
    const std::size_t size = chunk.rounded ? sizeof(float) : sizeof(double);
    const std::int32_t grain = chunk.first[c], second = chunk.second[c];
    const std::int32_t wall =
        of_meshes ? static_cast<std::int32_t>(in.walls.faces.size()) + mesh_of(second) : second;
    const WallPose& pose = in.walls.poses[wall];
    const Place& place = in.grains.place[grain];
    const Vec3 k = vector_of(chunk.touch->normal, c, size);
    const double normal = chunk.force->normal.get(c, size);
    const Vec3 point = place.position + (place.radius - chunk.touch->overlap.get(c, size)) * k;
    Vec3 force = normal * k, couple(0, 0, 0);
    Load& load = in.grains.load[grain];
    if (chunk.rubs) {
        const Vec3 across = vector_of(chunk.force->tangential, c, size);
        force += across;
        if (chunk.rolling) couple = vector_of(chunk.rolling->torque, c, size);
        load.torque -= chunk.touch->first_arm.get(c, size) * k.cross(across) + couple;
    }
    load.force -= force;
    const double power = force.dot(pose.now.velocity_at(point)) + couple.dot(pose.now.spin);
    in.grains.wall_work[grain] -= in.step * power;
    if (in.walls.tally) in.walls.tally->add(wall, force, normal, point - pose.point, couple);
}

void add_at_points(const WallLoads& in, bool of_meshes) {
    for (int c = 0; c < in.contacts.count; ++c)
        if (in.contacts.touch->touches(c)) add_at_point(in, of_meshes, c);
}

}  // namespace grainreel
