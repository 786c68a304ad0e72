#include "engine/run/import/arrival.hpp"

#include <utility>

namespace grainreel {

namespace {

// The contacts with the points where they act. Contacts of grains that do not touch in the frame are left
// out. They are contacts across a periodic side, or of another moment.
std::vector<SavedContact> records_of(const std::vector<Link>& touches, const State& frame,
                                     Arrival::LeftOut& left) {
    std::vector<SavedContact> records;
    left.of += std::ssize(touches);
    for (const Link& touch : touches) {
        const std::optional<std::size_t> first = frame.row_of(touch.first);
        if (!first) {
            ++left.without_grain;
            continue;
        }
        SavedContact one{touch.first, touch.second, touch.force, Vec3(0, 0, 0), frame.position[*first]};
        if (touch.second >= 0) {
            const std::optional<std::size_t> second = frame.row_of(touch.second);
            if (!second) {
                ++left.without_grain;
                continue;
            }
            const Vec3 between = frame.position[*second] - frame.position[*first];
            const double reach = frame.radius[*first] + frame.radius[*second];
            if (between.norm() > 1.04 * reach) {
                ++left.apart;
                continue;
            }
            one.point = frame.position[*first] + between * (frame.radius[*first] / reach);
        }
        records.push_back(one);
    }
    return records;
}

Measures::Names joined(std::vector<std::string> names, const std::vector<std::string>& more) {
    names.insert(names.end(), more.begin(), more.end());
    return std::make_shared<const std::vector<std::string>>(std::move(names));
}

}  // namespace

Arrival::Arrival(const std::filesystem::path& folder, const Scene& scene, ArrivalFacts facts)
    : folder_(folder),
      scene_(scene),
      facts_(std::move(facts)),
      motion_(scene.drive, facts_.clock),
      bodies_(bodies_of(scene)),
      trajectory_(folder / "trajectory.nc", facts_.header),
      measures_(scene, facts_.clock, facts_.supply, facts_.weighed),
      names_(joined(measures_.names(), facts_.more_columns)),
      table_(folder / "measures.csv", *names_),
      ranges_(scene, facts_.supply) {
    if (facts_.supply.contacts)
        contacts_.emplace(folder / "contacts.nc", facts_.header.title, facts_.header.program_version,
                          facts_.header.facts);
}

void Arrival::complete(State& frame) const {
    frame.cycles = facts_.clock.cycles(frame.step);
    frame.phase = facts_.clock.phase(frame.step);
    const DrivePose drive = motion_.at(frame.step);
    // The motions of the files' walls are part of the scene and pass through each moment.
    frame.bodies = poses_of(bodies_, drive);
    if (!facts_.in_container) return;
    for (std::size_t i = 0; i < frame.size(); ++i) {
        frame.position[i] += drive.offset;
        frame.velocity[i] += drive.velocity;
    }
}

void Arrival::take(const State& frame, const std::vector<Link>& touches, const std::vector<double>& more) {
    const std::int64_t number = trajectory_.frames();
    trajectory_.write(frame);
    if (contacts_) contacts_->write(number, records_of(touches, frame, left_out_));
    std::vector<double> row = measures_.row(frame, touches).values();
    row.insert(row.end(), more.begin(), more.end());
    table_.write({names_, std::move(row)});
    if (facts_.ranges) ranges_.add(frame, touches);
}

void Arrival::close() {
    if (facts_.ranges) ranges_.write(folder_);
}

}  // namespace grainreel
