#include "tests/engines/both_engines.hpp"

#include <cmath>
#include <numbers>

#include "engine/handover/decks/decks.hpp"
#include "engine/run/simulation/simulated_bed.hpp"
#include "engine/state/drive_motion.hpp"
#include "tests/engines/handed.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::test {

namespace {

Course read_theirs(const std::filesystem::path& folder, PeerEngine engine, const CarriedScene& carried) {
    Course course;
    const DriveMotion motion(carried.scene.drive, carried.plan.clock);
    for (const auto& [their_step, rows] : frames_of(engine, folder)) {
        const std::int64_t step = their_step - carried.shift();
        Moment now;
        now.time = carried.plan.clock.time(step);
        now.radius = rows.radius;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            now.species.push_back(rows.species[i]);
            now.position.push_back(rows.position[i]);
            if (carried.rides()) now.position.back() += motion.at(step).offset;
        }
        course.push_back(std::move(now));
    }
    return course;
}

Course run_ours(const CarriedScene& carried) {
    Course course;
    SimulatedBed run(carried.scene, carried.plan, 1);
    run.pack();
    for (const std::int64_t step : carried.dumps) {
        run.advance(step);
        const State frame = run.frame();
        Moment now;
        now.time = frame.time;
        now.species.assign(frame.species.begin(), frame.species.end());
        now.radius = frame.radius;
        now.position = frame.position;
        course.push_back(std::move(now));
    }
    return course;
}

template <class Value>
double mean_from(const Course& course, double from, const Value& value) {
    double sum = 0;
    int moments = 0;
    for (const Moment& now : course)
        if (now.time >= from && now.size() > 0) sum += value(now), ++moments;
    return moments > 0 ? sum / moments : std::nan("");
}

}  // namespace

BothCourses run_both(const std::string& text, const CarryRequest& request) {
    const TemporaryFolder folder;
    BothCourses both;
    both.carried = hand_over(text, request, folder.path());
    both.failure =
        run_engine(PeerProcess(request.engine, request.ranks, deck_name(request.engine)), folder.path());
    both.theirs = read_theirs(folder.path(), request.engine, both.carried);
    both.ours = run_ours(both.carried);
    return both;
}

double mean_height(const Course& course, double from, int species) {
    return mean_from(course, from, [&](const Moment& now) {
        double sum = 0, grains = 0;
        for (std::size_t i = 0; i < now.size(); ++i)
            if (now.species[i] == species) sum += now.position[i].z(), ++grains;
        return sum / grains;
    });
}

double mean_contacts(const Course& course, double from, double periodic) {
    return mean_from(course, from, [&](const Moment& now) {
        double contacts = 0;
        for (std::size_t i = 0; i < now.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                Vec3 between = now.position[i] - now.position[j];
                if (periodic > 0) between.x() -= periodic * std::round(between.x() / periodic);
                const double reach = now.radius[i] + now.radius[j];
                contacts += between.squaredNorm() < reach * reach;
            }
        return 2 * contacts / static_cast<double>(now.size());
    });
}

double mean_turning_weight(const Course& course, double from, double density) {
    return mean_from(course, from, [&](const Moment& now) {
        double torque = 0;
        for (std::size_t i = 0; i < now.size(); ++i)
            torque += 4.0 / 3 * std::numbers::pi * std::pow(now.radius[i], 3) * density * 9.81 *
                      now.position[i].y();
        return torque;
    });
}

double grains_left(const Course& course) {
    return static_cast<double>(course.front().size()) - static_cast<double>(course.back().size());
}

}  // namespace grainreel::test
