// A text dump as LAMMPS writes it (manual, command dump custom): `read_dump` of LAMMPS and LIGGGHTS takes it,
// and OVITO.
#include <cmath>

#include <fmt/format.h>

#include "engine/files/frames/frame_writer.hpp"

namespace grainreel {

namespace {

class LammpsDump final : public FrameWriter {
  public:
    explicit LammpsDump(const std::filesystem::path& path) : out_(path) {}

    void begin(const World& world, const FrameSupply& supply) override {
        world_ = world;
        supply_ = supply;
        out_.text() += "ITEM: UNITS\nsi\n";
    }
    void frame(const Frame& frame) override {
        std::string& text = out_.text();
        const WorldCell box = box_of(world_, frame);
        if (world_.time_known) text += fmt::format("ITEM: TIME\n{}\n", frame.time);
        text += fmt::format("ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\n", frame.step, frame.size());
        write_box(box, text);
        text += "ITEM: ATOMS id type x y z radius";
        if (supply_.velocities) text += " vx vy vz omegax omegay omegaz";
        if (!frame.orientation.empty()) text += " quati quatj quatk quatw";
        text += '\n';
        for (std::size_t i = 0; i < frame.size(); ++i) {
            const Vec3 &x = frame.position[i], &v = frame.velocity[i], &w = frame.spin[i];
            text += fmt::format("{} {} {} {} {} {}", frame.id[i], frame.species[i] + 1, x.x(), x.y(), x.z(),
                                frame.radius[i]);
            if (supply_.velocities)
                text += fmt::format(" {} {} {} {} {} {}", v.x(), v.y(), v.z(), w.x(), w.y(), w.z());
            if (!frame.orientation.empty()) {
                const Quaternion& q = frame.orientation[i];
                text += fmt::format(" {} {} {} {}", q.x(), q.y(), q.z(), q.w());
            }
            text += '\n';
            out_.pass();
        }
    }
    void end() override { out_.flush(); }

  private:
    // A tilted box is written by the bounds of the box around it (manual, Howto_triclinic).
    static void write_box(const WorldCell& box, std::string& text) {
        const double xy = box.edges[1].x(), xz = box.edges[2].x(), yz = box.edges[2].y();
        const auto flag = [&](std::size_t axis) { return box.periodic[axis] ? "pp" : "ff"; };
        const std::string flags = fmt::format("{} {} {}", flag(0), flag(1), flag(2));
        const double lx = box.edges[0].x(), ly = box.edges[1].y(), lz = box.edges[2].z();
        const Vec3& low = box.origin;
        if (xy == 0 && xz == 0 && yz == 0) {
            text += fmt::format("ITEM: BOX BOUNDS {}\n{} {}\n{} {}\n{} {}\n", flags, low.x(), low.x() + lx,
                                low.y(), low.y() + ly, low.z(), low.z() + lz);
            return;
        }
        const double less_x = std::min({0.0, xy, xz, xy + xz}), more_x = std::max({0.0, xy, xz, xy + xz});
        const double less_y = std::min(0.0, yz), more_y = std::max(0.0, yz);
        text += fmt::format("ITEM: BOX BOUNDS xy xz yz {}\n{} {} {}\n{} {} {}\n{} {} {}\n", flags,
                            low.x() + less_x, low.x() + lx + more_x, xy, low.y() + less_y,
                            low.y() + ly + more_y, xz, low.z(), low.z() + lz, yz);
    }

    TextPieces out_;
    World world_;
    FrameSupply supply_;
};

std::unique_ptr<FrameWriter> make(const std::filesystem::path& path) {
    return std::make_unique<LammpsDump>(path);
}

}  // namespace

FrameFormat lammps_dump_format() {
    return {"lammps-dump", "text dump of LAMMPS and LIGGGHTS; OVITO opens it", ".dump", make};
}

}  // namespace grainreel
