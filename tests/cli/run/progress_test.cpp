// Tests of words and numbers of the progress line, of threads and of the pace.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/base/team.hpp"
#include "engine/run/driver/pace.hpp"
#include "render/app/messages/reporter.hpp"
#include "render/film/sources/film_request.hpp"

namespace grainreel {
namespace {

Progress vibrating() {
    Progress p;
    p.stage = Progress::Stage::vibrating;
    p.done = 0.32;
    p.time = 3.2;
    p.end = 10;
    p.particle_steps_per_second = 12.44e6;
    p.frames = 96;
    p.frames_planned = 300;
    p.elapsed = 31;
    p.remaining = 64.2;
    return p;
}

TEST(ProgressLine, SaysAll) {
    EXPECT_EQ(progress_line(vibrating(), 200),
              "running   3.20 of 10.00 s   12.4 M particle-steps/s   frame 96 of 300   1 min 05 s left");
}

TEST(ProgressLine, KeepsToTheWidthByWholeParts) {
    const std::string whole = progress_line(vibrating(), 200);
    for (int width = 0; width < 100; ++width) {
        const std::string line = progress_line(vibrating(), width);
        EXPECT_LE(static_cast<int>(line.size()), width);
        EXPECT_TRUE(whole.starts_with(line));
        const bool cut = line.size() < whole.size() && !line.empty();
        EXPECT_TRUE(!cut || whole.substr(line.size(), 3) == "   ") << line;
    }
    EXPECT_EQ(progress_line(vibrating(), 30), "running   3.20 of 10.00 s");
}

TEST(ProgressLine, OfPackingIsAShare) {
    Progress p;
    p.done = 0.425;
    EXPECT_EQ(progress_line(p, 80), "filling    42 %");
    p.stage = Progress::Stage::settling;
    EXPECT_EQ(progress_line(p, 80), "settling   42 %");
}

TEST(ProgressJson, IsOneObjectInOneLine) {
    const std::string text = progress_json(vibrating());
    EXPECT_EQ(text.find('\n'), std::string::npos);
    const nlohmann::json object = nlohmann::json::parse(text);
    EXPECT_EQ(object["event"], "progress");
    EXPECT_EQ(object["stage"], "vibrating");
    EXPECT_EQ(object["time_s"], 3.2);
    EXPECT_EQ(object["end_s"], 10);
    EXPECT_EQ(object["frames"], 96);
    EXPECT_EQ(object["particle_steps_per_second"], 12.44e6);
    EXPECT_EQ(object["remaining_s"], 64.2);
    Progress unknown;
    EXPECT_FALSE(nlohmann::json::parse(progress_json(unknown)).contains("remaining_s"));
}

TEST(DurationText, ChoosesItsUnits) {
    EXPECT_EQ(duration_text(0), "0 s");
    EXPECT_EQ(duration_text(0.42), "0.4 s");
    EXPECT_EQ(duration_text(9.97), "10 s");
    EXPECT_EQ(duration_text(59.4), "59 s");
    EXPECT_EQ(duration_text(59.6), "1 min 00 s");
    EXPECT_EQ(duration_text(65), "1 min 05 s");
    EXPECT_EQ(duration_text(2 * 3600 + 3 * 60), "2 h 03 min");
}

TEST(ThreadPlan, GivesEveryPartAThreadAndTheEngineMost) {
    for (int processors = 1; processors <= 64; ++processors) {
        const ThreadPlan plan = plan_threads(processors, true, 100000);
        EXPECT_GE(plan.raster, 1);
        EXPECT_GE(plan.encoder, 1);
        EXPECT_GE(plan.engine, std::max(plan.raster, plan.encoder));
        EXPECT_TRUE(processors <= 2 || plan.engine + plan.raster + plan.encoder <= processors + 1)
            << processors;
        EXPECT_EQ(plan_threads(processors, false, 100000).engine, processors);
    }
    EXPECT_EQ(plan_threads(2, true, 1620).engine, 2);
    EXPECT_EQ(plan_threads(8, true, 251).engine, 1) << "too few grains to share";
    EXPECT_GE(usable_processors(), 1);
}

TEST(Pace, FindsStretchesOfATenthOfASecond) {
    Pace pace;
    for (int i = 0; i < 30; ++i)
        pace.took(pace.steps(), static_cast<double>(pace.steps()) * 1e-4);  // 10,000 steps/s
    EXPECT_NEAR(static_cast<double>(pace.steps()), 1000, 1);
    pace.took(1000, 1.0);  // ten times slower from here
    EXPECT_NEAR(static_cast<double>(pace.steps()), 100, 1);
    pace.took(1, 10.0);
    EXPECT_EQ(pace.steps(), 1);
}

TEST(RecentRate, IsTheMeanAtFirstAndThenForgets) {
    RecentRate rate;
    EXPECT_EQ(rate.value(), 0);
    rate.add(3, 1e-3);
    rate.add(9, 1e-3);
    EXPECT_NEAR(rate.value(), 6000, 5);
    for (int i = 0; i < 200; ++i) rate.add(10, 0.1);
    EXPECT_NEAR(rate.value(), 100, 1);
}

}  // namespace
}  // namespace grainreel
