// What a page's worker calls: plain functions with numbers, texts and addresses in the engine's memory. Each
// gives the text of a JSON object, {"error": ...} where it failed, or a number.
#include <emscripten.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/base/mathematics.hpp"
#include "engine/play/played_bed.hpp"

namespace grainreel {

namespace {

using Json = nlohmann::json;

constexpr double steps_of_place = 65535, speed_steps = 253, speed_span = 1e5;
constexpr std::uint16_t absent = 0xfeff;
constexpr std::uint8_t most_contacts = 253;

struct Page {
    std::unique_ptr<PlayedBed> bed;
    std::string answer;                // the text that was given last
    std::vector<std::string> columns;  // what is measured for the charts
    Vec3 low{0, 0, 0}, high{0, 0, 0};  // m, the box of places
    double highest_speed = 1;          // m/s
    std::vector<std::uint16_t>
        packed;                // x, y, z and speed with contacts, for each id; as page_bed.js has them
    std::vector<float> radii;  // m, by id
    std::vector<std::uint16_t> species;  // by id
    std::vector<std::int32_t> pairs;     // two ids a pair, -1 for a wall
    std::vector<float> forces;           // N, a pair
};

Page page;

const char* answer(const Json& json) {
    page.answer = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    return page.answer.c_str();
}

template <class Action>
const char* answered(const Action& action) {
    try {
        return answer(action());
    } catch (const std::exception& problem) {
        return answer({{"error", words_of(problem)}});
    }
}

Vec3 vec(const Json& numbers) {
    return Vec3(numbers.at(0).get<double>(), numbers.at(1).get<double>(), numbers.at(2).get<double>());
}

Json told_plan() {
    const Plan& plan = page.bed->plan();
    return {{"step", plan.clock.step},
            {"steps", plan.steps},
            {"grains", page.bed->scene().grains()},
            {"overlap", plan.expected_overlap},
            {"warnings", plan.warnings}};
}

std::uint16_t place_number(double x, int axis) {
    const double share = (x - page.low[axis]) / (page.high[axis] - page.low[axis]);
    return static_cast<std::uint16_t>(std::lround(std::clamp(share, 0.0, 1.0) * steps_of_place));
}

std::uint8_t speed_byte(double speed) {
    const double share = 1 + math::log(std::max(speed, 1e-300) / page.highest_speed) / math::log(speed_span);
    return static_cast<std::uint8_t>(share < 0 ? 0
                                               : std::clamp(std::lround(share * speed_steps) + 1, 1L, 254L));
}

// Fills the arrays of grains, by their ids, and of the pairs that push each other.
void take_frame(const State& frame) {
    const auto capacity = static_cast<std::size_t>(page.bed->scene().grains());
    page.packed.assign(4 * capacity, 0);
    for (std::size_t id = 0; id < capacity; ++id) page.packed[4 * id + 3] = absent;
    page.radii.resize(capacity, 0);
    page.species.resize(capacity, 0);
    for (std::size_t i = 0; i < frame.size(); ++i) {
        const auto id = static_cast<std::size_t>(frame.id[i]);
        if (id >= capacity) continue;
        for (int axis = 0; axis < 3; ++axis)
            page.packed[4 * id + axis] = place_number(frame.position[i][axis], axis);
        page.packed[4 * id + 3] = speed_byte(frame.velocity[i].norm());
        page.radii[id] = static_cast<float>(frame.radius[i]);
        page.species[id] = static_cast<std::uint16_t>(frame.species[i]);
    }
}

void take_pairs() {
    page.pairs.clear();
    page.forces.clear();
    std::vector<std::uint8_t> contacts(page.radii.size(), 0);
    const auto count = [&](std::int32_t id) {
        if (id >= 0 && static_cast<std::size_t>(id) < contacts.size() && contacts[id] < most_contacts)
            ++contacts[id];
    };
    for (const auto& one : page.bed->bed().contacts()) {
        page.pairs.push_back(one.first);
        page.pairs.push_back(std::max(one.second, -1));
        page.forces.push_back(static_cast<float>(one.normal));
        count(one.first);
        count(one.second);
    }
    for (std::size_t id = 0; id < contacts.size(); ++id)
        if (page.packed[4 * id + 3] != absent)
            page.packed[4 * id + 3] = static_cast<std::uint16_t>(page.packed[4 * id + 3] | contacts[id] << 8);
}

Json bodies_of(const State& frame) {
    Json bodies = Json::array();
    for (const BodyPose& pose : frame.bodies) {
        const Quaternion& turn = pose.rotation;
        bodies.push_back(
            {pose.place.x(), pose.place.y(), pose.place.z(), turn.w(), turn.x(), turn.y(), turn.z()});
    }
    return bodies;
}

template <class T>
std::uintptr_t address(const std::vector<T>& list) {
    return reinterpret_cast<std::uintptr_t>(list.data());
}

}  // namespace

extern "C" {

// request: {planned, open, turned: {key: value}, columns: [name], low: [x, y, z], high, speed}
EMSCRIPTEN_KEEPALIVE const char* play_begin(const char* request) {
    return answered([&]() -> Json {
        const Json json = Json::parse(request);
        page.bed.reset();
        page.bed = std::make_unique<PlayedBed>(json.at("planned").get<std::string>(),
                                               json.at("open").get<std::string>(),
                                               json.at("turned").get<PlayedBed::Turned>());
        page.columns = json.at("columns").get<std::vector<std::string>>();
        page.low = vec(json.at("low"));
        page.high = vec(json.at("high"));
        page.highest_speed = json.at("speed");
        page.radii.clear();
        page.species.clear();
        return told_plan();
    });
}

// The worker's `packing` is called along the way, with the stage and the share that is done.
EMSCRIPTEN_KEEPALIVE const char* play_pack() {
    return answered([&]() -> Json {
        const PackingResult result = page.bed->pack([](const PackingProgress& now) {
            EM_ASM({ Module["packing"]($0, $1); }, static_cast<int>(now.stage), now.done);
            return true;
        });
        return {{"settled", result.settled}, {"time", result.settle_time}};
    });
}

// Goes on by at most so many steps, and stops after the step in which `milliseconds` are over. Gives the
// steps made.
EMSCRIPTEN_KEEPALIVE const char* play_run(double steps, double milliseconds) {
    return answered([&]() -> Json {
        const double until = emscripten_get_now() + milliseconds;
        const std::int64_t begin = page.bed->bed().step(), most = std::llround(steps);
        constexpr std::int64_t at_once = 16;
        while (!page.bed->is_over() && page.bed->bed().step() - begin < most) {
            page.bed->advance(std::min<std::int64_t>(at_once, most - (page.bed->bed().step() - begin)));
            if (emscripten_get_now() >= until) break;
        }
        return {{"made", page.bed->bed().step() - begin}, {"over", page.bed->is_over()}};
    });
}

// The bed as it is now. Addresses are those of the engine's memory, and hold until the next call.
EMSCRIPTEN_KEEPALIVE const char* play_frame(int with_pairs) {
    return answered([&]() -> Json {
        const State frame = page.bed->bed().frame();
        take_frame(frame);
        if (with_pairs != 0) take_pairs();
        return {{"step", frame.step},
                {"time", frame.time},
                {"cycles", frame.cycles},
                {"bodies", bodies_of(frame)},
                {"grains", page.radii.size()},
                {"there", frame.size()},
                {"packed", address(page.packed)},
                {"radii", address(page.radii)},
                {"species", address(page.species)},
                {"pairs", with_pairs != 0 ? page.forces.size() : 0},
                {"pairsAt", address(page.pairs)},
                {"forcesAt", address(page.forces)}};
    });
}

EMSCRIPTEN_KEEPALIVE const char* play_measures() {
    return answered([&]() -> Json {
        Json values = Json::array();
        for (const std::string& column : page.columns) {
            const double value = page.bed->bed().measure(column);
            values.push_back(std::isfinite(value) ? Json(value) : Json(nullptr));
        }
        return {{"values", values}};
    });
}

EMSCRIPTEN_KEEPALIVE const char* play_turn(const char* key, double value) {
    return answered([&]() -> Json {
        page.bed->turn(key, value);
        return told_plan();
    });
}

EMSCRIPTEN_KEEPALIVE const char* play_shake(int how) {
    return answered([&]() -> Json {
        page.bed->shake(static_cast<PlayedBed::Shaking>(how));
        return Json::object();
    });
}

EMSCRIPTEN_KEEPALIVE const char* play_tilt(double angle) {
    return answered([&]() -> Json {
        page.bed->tilt(angle);
        return Json::object();
    });
}

EMSCRIPTEN_KEEPALIVE const char* play_scene() {
    return answered([&]() -> Json { return {{"text", page.bed->scene_text()}}; });
}

EMSCRIPTEN_KEEPALIVE const char* play_hash() {
    return answered([&]() -> Json {
        return {{"hash", fmt::format("{:016x}", page.bed->bed().state_hash())},
                {"step", page.bed->bed().step()}};
    });
}

}  // extern "C"

}  // namespace grainreel

int main() {
    return 0;
}
