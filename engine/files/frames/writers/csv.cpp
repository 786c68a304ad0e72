// One long table of all frames, a row a grain and moment: for spreadsheets, pandas and R.
#include <fmt/format.h>

#include "engine/files/frames/frame_writer.hpp"

namespace grainreel {

namespace {

class Csv final : public FrameWriter {
  public:
    explicit Csv(const std::filesystem::path& path) : out_(path) {}

    void begin(const World& world, const FrameSupply& supply) override {
        world_ = world;
        supply_ = supply;
        out_.text() += "time,step,id,type,species,x,y,z,radius";
        if (supply.velocities) out_.text() += ",vx,vy,vz,wx,wy,wz";
        if (supply.contact_numbers) out_.text() += ",contact_number";
        out_.text() += '\n';
    }
    void frame(const Frame& frame) override {
        for (std::size_t i = 0; i < frame.size(); ++i) {
            std::string& text = out_.text();
            const Vec3 &x = frame.position[i], &v = frame.velocity[i], &w = frame.spin[i];
            const auto s = static_cast<std::size_t>(frame.species[i]);
            text += fmt::format("{},{},{},{},{},{},{},{},{}", frame.time, frame.step, frame.id[i], s + 1,
                                s < world_.species.size() ? one_word(world_.species[s].name) : "", x.x(),
                                x.y(), x.z(), frame.radius[i]);
            if (supply_.velocities)
                text += fmt::format(",{},{},{},{},{},{}", v.x(), v.y(), v.z(), w.x(), w.y(), w.z());
            if (supply_.contact_numbers)
                text += fmt::format(",{}", i < frame.contact_number.size() ? frame.contact_number[i] : 0);
            text += '\n';
            out_.pass();
        }
    }
    void end() override { out_.flush(); }

  private:
    TextPieces out_;
    World world_;
    FrameSupply supply_;
};

std::unique_ptr<FrameWriter> make(const std::filesystem::path& path) {
    return std::make_unique<Csv>(path);
}

}  // namespace

FrameFormat csv_format() {
    return {"csv", "one table of all frames, SI units: for spreadsheets, pandas and R", ".csv", make};
}

}  // namespace grainreel
