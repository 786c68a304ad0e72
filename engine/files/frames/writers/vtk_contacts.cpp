#include "engine/files/frames/writers/vtk_contacts.hpp"

#include <algorithm>
#include <cmath>

namespace grainreel {

namespace {

// The row of an id; as many as there are rows where the frame has no such grain.
std::size_t row_of(const Frame& frame, std::int32_t id) {
    const auto found = std::lower_bound(frame.id.begin(), frame.id.end(), id);
    return found == frame.id.end() || *found != id ? frame.size()
                                                   : static_cast<std::size_t>(found - frame.id.begin());
}

// The shortest of the ways that differ by edges of the periodic cell.
Vec3 shortest(Vec3 way, const World& world) {
    if (!world.cell) return way;
    for (std::size_t edge = 3; edge-- > 0;) {
        const Vec3& along = world.cell->edges[edge];
        const double length = along[static_cast<Eigen::Index>(edge)];
        if (world.cell->periodic[edge] && length > 0)
            way -= std::round(way[static_cast<Eigen::Index>(edge)] / length) * along;
    }
    return way;
}

// The way from the first grain's centre to the second's, or to the point on a wall.
Vec3 way_of(const Frame& frame, const ContactRecord& contact, std::size_t first, std::size_t second,
            const World& world) {
    const Vec3 end = second < frame.size() ? frame.position[second] : contact.point;
    return shortest(end - frame.position[first], world);
}

Vec3 direction(const Vec3& way) {
    const double length = way.norm();
    return length > 0 ? Vec3(way / length) : Vec3(0, 0, 0);
}

void put(std::vector<double>& to, const Vec3& v) {
    to.insert(to.end(), {v.x(), v.y(), v.z()});
}

class Lines {
  public:
    Lines() {
        data_.cells = VtkPolyData::Cells::lines;
        data_.points_a_cell = 2;
    }
    void add(const Vec3& from, const Vec3& to, std::int32_t first, std::int32_t second, double normal) {
        for (const Vec3& end : {from, to}) {
            data_.connectivity.push_back(static_cast<std::int64_t>(data_.points.size() / 3));
            put(data_.points, end);
        }
        normal_.push_back(normal);
        first_.push_back(first);
        second_.push_back(second);
        wall_.push_back(second < 0 ? 1 : 0);
    }
    VtkPolyData data() {
        data_.cell_data = {VtkList::doubles("normal_force", normal_), VtkList::integers("id1", first_),
                           VtkList::integers("id2", second_), VtkList::integers("to_wall", wall_)};
        return std::move(data_);
    }

  private:
    VtkPolyData data_;
    std::vector<double> normal_;
    std::vector<std::int64_t> first_, second_, wall_;
};

}  // namespace

VtkPolyData contact_lines(const Frame& frame, const std::vector<ContactRecord>& contacts,
                          const World& world) {
    Lines lines;
    std::vector<double> tangential, force;
    for (const ContactRecord& contact : contacts) {
        const std::size_t a = row_of(frame, contact.first);
        const std::size_t b = contact.second < 0 ? frame.size() : row_of(frame, contact.second);
        if (a == frame.size() || (contact.second >= 0 && b == frame.size())) continue;
        const Vec3 way = way_of(frame, contact, a, b, world);
        lines.add(frame.position[a], frame.position[a] + way, contact.first, contact.second, contact.normal);
        put(tangential, contact.tangential);
        put(force, contact.normal * direction(way) + contact.tangential);
    }
    VtkPolyData data = lines.data();
    data.cell_data.push_back(VtkList::doubles("tangential_force", tangential, 3));
    data.cell_data.push_back(VtkList::doubles("force", force, 3));
    return data;
}

VtkPolyData contact_lines(const Frame& frame, const std::vector<Touch>& touches, const World& world) {
    Lines lines;
    for (const Touch& touch : touches) {
        const std::size_t a = row_of(frame, touch.first);
        const std::size_t b = touch.second < 0 ? frame.size() : row_of(frame, touch.second);
        if (a == frame.size() || b == frame.size()) continue;
        const Vec3 way = shortest(frame.position[b] - frame.position[a], world);
        lines.add(frame.position[a], frame.position[a] + way, touch.first, touch.second, touch.force);
    }
    return lines.data();
}

std::vector<Vec3> forces_on_grains(const Frame& frame, const std::vector<ContactRecord>& contacts,
                                   const World& world) {
    std::vector<Vec3> forces(frame.size(), Vec3(0, 0, 0));
    for (const ContactRecord& contact : contacts) {
        const std::size_t a = row_of(frame, contact.first);
        const std::size_t b = contact.second < 0 ? frame.size() : row_of(frame, contact.second);
        if (a == frame.size() || (contact.second >= 0 && b == frame.size())) continue;
        const Vec3 on_second =
            contact.normal * direction(way_of(frame, contact, a, b, world)) + contact.tangential;
        forces[a] -= on_second;
        if (b < frame.size()) forces[b] += on_second;
    }
    return forces;
}

}  // namespace grainreel
