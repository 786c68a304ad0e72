// Tests of the reader of GSD files.
#include <array>
#include <cmath>
#include <cstring>
#include <map>

#include "engine/files/foreign/foreign_archive.hpp"
#include "tests/foreign/small_files.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {

RawFormat gsd_format();

namespace {

using namespace small_files;
using test::tells;
using testing::ElementsAre;
using testing::HasSubstr;

template <class T>
void put(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Writes GSD files by the specification: header, chunks, index, names.
class GsdBytes {
  public:
    template <class T>
    void chunk(std::uint64_t frame, const std::string& name, std::uint32_t columns,
               const std::vector<T>& values) {
        Entry entry{frame,   values.size() / columns, header_size + data_.size(),
                    columns, number_of(name),         type_of(T{})};
        for (const T& value : values) put(data_, value);
        entries_.push_back(entry);
    }
    void text(std::uint64_t frame, const std::string& name, const std::vector<std::string>& rows) {
        std::size_t width = 0;
        for (const std::string& row : rows) width = std::max(width, row.size() + 1);
        std::vector<std::uint8_t> codes;
        for (std::string row : rows) {
            row.resize(width, '\0');
            codes.insert(codes.end(), row.begin(), row.end());
        }
        chunk(frame, name, static_cast<std::uint32_t>(width), codes);
    }

    std::string schema = "hoomd";
    std::uint32_t layer = 2;
    // The number of rows of the last chunk, which a test can make wrong.
    std::uint64_t& last_rows() { return entries_.back().rows; }
    std::uint64_t& last_place() { return entries_.back().place; }
    std::uint64_t& last_frame() { return entries_.back().frame; }

    std::string bytes() const {
        std::string index, names;
        for (const Entry& e : entries_) {
            put(index, e.frame);
            put(index, e.rows);
            put(index, e.place);
            put(index, e.columns);
            put(index, e.name);
            put(index, e.type);
            put(index, std::uint8_t{0});
        }
        index.append(2 * 32, '\0');
        for (const std::string& name : names_) {
            names += name + '\0';
            if (layer == 1) names.resize((names.size() + 63) / 64 * 64, '\0');
        }
        names.resize((names.size() + 64) / 64 * 64, '\0');
        std::string head;
        put(head, std::uint64_t{0x65DF65DF65DF65DFu});
        put(head, std::uint64_t{header_size + data_.size()});
        put(head, std::uint64_t{index.size() / 32});
        put(head, std::uint64_t{header_size + data_.size() + index.size()});
        put(head, std::uint64_t{names.size() / 64});
        put(head, std::uint32_t{0x10004});
        put(head, std::uint32_t{layer << 16});
        std::string application = "a test", written_schema = schema;
        application.resize(64, '\0');
        written_schema.resize(64, '\0');
        head += application + written_schema;
        head.resize(header_size, '\0');
        return head + data_ + index + names;
    }

  private:
    static constexpr std::size_t header_size = 256;
    struct Entry {
        std::uint64_t frame, rows, place;
        std::uint32_t columns;
        std::uint16_t name;
        std::uint8_t type;
    };
    static std::uint8_t type_of(std::uint8_t) { return 1; }
    static std::uint8_t type_of(std::uint32_t) { return 3; }
    static std::uint8_t type_of(std::uint64_t) { return 4; }
    static std::uint8_t type_of(std::int32_t) { return 7; }
    static std::uint8_t type_of(float) { return 9; }
    static std::uint8_t type_of(double) { return 10; }
    std::uint16_t number_of(const std::string& name) {
        for (std::size_t i = 0; i < names_.size(); ++i)
            if (names_[i] == name) return static_cast<std::uint16_t>(i);
        names_.push_back(name);
        return static_cast<std::uint16_t>(names_.size() - 1);
    }

    std::string data_;
    std::vector<Entry> entries_;
    std::vector<std::string> names_;
};

using Floats = std::vector<float>;
using Counts = std::vector<std::uint32_t>;

// Two grains in a tilted box. The second frame only moves them, and the third has three grains.
std::vector<std::string> names_of(const RawTable& table) {
    std::vector<std::string> names;
    for (const RawColumn& column : table.columns) names.push_back(column.name);
    return names;
}

GsdBytes bed() {
    GsdBytes gsd;
    gsd.chunk(0, "configuration/box", 6, Floats{4, 5, 6, 0.5F, 0, 0.25F});
    gsd.chunk(0, "particles/N", 1, Counts{2});
    gsd.chunk(0, "particles/position", 3, Floats{1, 2, 3, 4, 5, 6});
    gsd.chunk(0, "particles/velocity", 3, Floats{.25F, .5F, .75F, 1, 2, 3});
    gsd.chunk(0, "particles/diameter", 1, Floats{0.5F, 0.25F});
    gsd.chunk(0, "particles/typeid", 1, Counts{1, 0});
    gsd.text(0, "particles/types", {"small", "big"});
    gsd.chunk(1, "configuration/step", 1, std::vector<std::uint64_t>{1000});
    gsd.chunk(1, "particles/position", 3, Floats{7, 8, 9, 10, 11, 12});
    gsd.chunk(1, "particles/orientation", 4, Floats{0, 1, 0, 0, 0, 0, 1, 0});
    gsd.chunk(1, "log/bed/time", 1, std::vector<double>{0.5});
    gsd.chunk(1, "log/particles/heat", 1, std::vector<double>{20, 30});
    gsd.chunk(2, "particles/N", 1, Counts{3});
    gsd.chunk(2, "particles/position", 3, Floats{1, 1, 1, 2, 2, 2, 3, 3, 3});
    return gsd;
}

TEST(Gsd, BothLayersOfNamesAreRead) {
    for (const std::uint32_t layer : {1u, 2u}) {
        GsdBytes gsd = bed();
        gsd.layer = layer;
        ASSERT_TRUE(takes(gsd_format(), gsd.bytes()));
        const RawFrame frame = frame_of(gsd_format(), gsd.bytes());
        EXPECT_THAT(column(frame.grains, "x"), ElementsAre(1, 4)) << layer;
        EXPECT_THAT(column(frame.grains, "velocity:2"), ElementsAre(0.75, 3));
        EXPECT_THAT(words(frame.grains, "type"), ElementsAre("big", "small"));
        EXPECT_EQ(frame.step, 0);
    }
}

TEST(Gsd, TheBoxIsCentredAndTiltsAreRatios) {
    const RawFrame frame = frame_of(gsd_format(), bed().bytes());
    ASSERT_TRUE(frame.box.has_value());
    EXPECT_EQ(frame.box->edges[0], Vec3(4, 0, 0));
    EXPECT_EQ(frame.box->edges[1], Vec3(0.5 * 5, 5, 0));
    EXPECT_EQ(frame.box->edges[2], Vec3(0, 0.25 * 6, 6));
    EXPECT_EQ(frame.box->origin, -0.5 * Vec3(4 + 2.5, 5 + 1.5, 6));
    EXPECT_THAT(frame.box->periodic, ElementsAre(true, true, true));
}

TEST(Gsd, WhatAFrameLacksIsThatOfTheFirst) {
    const RawFrame frame = frame_of(gsd_format(), bed().bytes(), 1);
    EXPECT_EQ(frame.step, 1000);
    EXPECT_EQ(frame.time, 0.5);
    EXPECT_THAT(column(frame.grains, "y"), ElementsAre(8, 11));
    EXPECT_THAT(column(frame.grains, "diameter"), ElementsAre(0.5, 0.25));
    EXPECT_THAT(words(frame.grains, "type"), ElementsAre("big", "small"));
    EXPECT_THAT(column(frame.grains, "orientation:1"), ElementsAre(1, 0));
    EXPECT_THAT(column(frame.grains, "log/particles/heat"), ElementsAre(20, 30));
}

// Columns are known by their places, so a frame with one grain must have the column of ids too.
TEST(Gsd, WhatIsLoggedForEachGrainIsAColumnOfEveryFrame) {
    GsdBytes gsd = bed();
    gsd.chunk(3, "particles/N", 1, Counts{1});
    gsd.chunk(3, "particles/position", 3, Floats{1, 2, 3});
    gsd.chunk(3, "log/particles/heat", 1, std::vector<double>{7});
    const std::vector<std::string> names = names_of(frame_of(gsd_format(), gsd.bytes(), 1).grains);
    for (const std::size_t frame : {0, 2, 3})
        EXPECT_EQ(names_of(frame_of(gsd_format(), gsd.bytes(), frame).grains), names) << frame;
    EXPECT_THAT(column(frame_of(gsd_format(), gsd.bytes(), 3).grains, "log/particles/heat"), ElementsAre(7));
    EXPECT_TRUE(std::isnan(column(frame_of(gsd_format(), gsd.bytes(), 2).grains, "log/particles/heat")[0]));
}

// The schema's defaults hold, but a diameter of 1 m, a mass of 1 kg and grains at rest are not believed.
TEST(Gsd, WhereTheCountIsAnotherTheDefaultHolds) {
    EXPECT_THAT(counts(gsd_format(), bed().bytes()), ElementsAre(2, 2, 3));
    const RawFrame frame = frame_of(gsd_format(), bed().bytes(), 2);
    for (const char* name : {"velocity:0", "diameter"})
        EXPECT_THAT(column(frame.grains, name),
                    ElementsAre(testing::IsNan(), testing::IsNan(), testing::IsNan()));
    EXPECT_THAT(column(frame.grains, "orientation:0"), ElementsAre(1, 1, 1));
    EXPECT_THAT(words(frame.grains, "type"), ElementsAre("small", "small", "small"));
}

TEST(Gsd, AStepThatNoRunReachesIsRefused) {
    GsdBytes gsd = bed();
    gsd.chunk(2, "configuration/step", 1, std::vector<std::uint64_t>{std::uint64_t{1} << 63});
    EXPECT_THAT(complaint_of(gsd_format(), gsd.bytes()), tells({"frame 2", "step", "no run reaches"}));
}

TEST(Gsd, APlaceFarOutsideOfTheBoxIsRefused) {
    GsdBytes gsd = bed();
    gsd.chunk(2, "particles/position", 3, Floats{1, 1, 1, 2, 2, 2, 3, 1e5F, 3});
    EXPECT_THAT(complaint_of(gsd_format(), gsd.bytes()),
                tells({"grain 2", "frame 2", "y", "outside of the box"}));
}

TEST(Gsd, ShapesThatAreNoSpheresAreTold) {
    GsdBytes gsd = bed();
    gsd.text(0, "particles/type_shapes",
             {R"({"type": "Sphere", "diameter": 2})", R"({"type": "ConvexPolyhedron", "vertices": []})"});
    EXPECT_THAT(news_of(gsd_format(), gsd.bytes()), tells({"no spheres", "ConvexPolyhedron"}));
    EXPECT_EQ(news_of(gsd_format(), bed().bytes()), "");
}

// Three grains of the types Sphere, Ellipsoid and Sphere.
GsdBytes ellipsoids() {
    GsdBytes gsd;
    gsd.chunk(0, "particles/N", 1, Counts{3});
    gsd.chunk(0, "particles/position", 3, Floats{1, 2, 3, 4, 5, 6, 7, 8, 9});
    gsd.chunk(0, "particles/typeid", 1, Counts{0, 1, 0});
    gsd.text(0, "particles/types", {"ball", "egg"});
    gsd.text(
        0, "particles/type_shapes",
        {R"({"type": "Sphere", "diameter": 0.5})", R"({"type": "Ellipsoid", "a": 1, "b": 1, "c": 2.5})"});
    return gsd;
}

TEST(Gsd, EllipsoidsHaveTheirHalfLengths) {
    const GsdBytes gsd = ellipsoids();
    const RawTable grains = frame_of(gsd_format(), gsd.bytes()).grains;
    EXPECT_THAT(column(grains, "type_shapes:a"), ElementsAre(0.25, 1, 0.25));
    EXPECT_THAT(column(grains, "type_shapes:c"), ElementsAre(0.25, 2.5, 0.25));
    EXPECT_THAT(column(grains, "orientation:0"), ElementsAre(1, 1, 1));
    EXPECT_EQ(news_of(gsd_format(), gsd.bytes()), "");
}

TEST(Gsd, EllipsoidsAreGrainsOfTheirShape) {
    GsdBytes gsd = ellipsoids();
    const float half = std::sqrt(0.5F);
    gsd.chunk(0, "particles/orientation", 4, Floats{1, 0, 0, 0, half, half, 0, 0, 1, 0, 0, 0});
    gsd.chunk(1, "particles/position", 3, Floats{1, 2, 3, 4, 5, 6, 7, 8, 10});
    const OneFile file(gsd.bytes());
    const ForeignArchive archive(file.path(), {});
    EXPECT_TRUE(archive.supply().shapes);
    const State state = archive.grains(1);
    ASSERT_EQ(state.shape.size(), 3U);
    EXPECT_EQ(state.shape[1].half, Vec3(1, 1, 2.5));
    EXPECT_EQ(state.shape[1].along, 2);
    EXPECT_EQ(state.shape[2].half, Vec3(0.25, 0.25, 0.25));
    EXPECT_NEAR(state.orientation[1].x(), half, 1e-7);
    EXPECT_NEAR(state.radius[1], std::cbrt(2.5), 1e-12);  // of the sphere of the same volume
    EXPECT_NEAR(state.radius[0], 0.25, 1e-15);
}

// A polyhedron is a sphere of its grain's diameter beside ellipsoids. If it has none, all are spheres.
TEST(Gsd, OtherShapesBesideEllipsoids) {
    const auto shaped = [](bool diameters) {
        GsdBytes gsd = bed();
        if (!diameters) {
            gsd = GsdBytes();
            gsd.chunk(0, "particles/N", 1, Counts{2});
            gsd.chunk(0, "particles/position", 3, Floats{1, 2, 3, 4, 5, 6});
            gsd.text(0, "particles/types", {"A", "B"});
        }
        gsd.text(0, "particles/type_shapes",
                 {R"({"type": "Ellipsoid", "a": 1, "b": 2, "c": 3})", R"({"type": "ConvexPolyhedron"})"});
        return gsd.bytes();
    };
    EXPECT_TRUE(frame_of(gsd_format(), shaped(true)).grains.find("type_shapes:a"));
    const std::string news = news_of(gsd_format(), shaped(true));
    EXPECT_THAT(news, tells({"ConvexPolyhedron", "drawn as spheres"}));
    EXPECT_THAT(news, testing::Not(HasSubstr("Ellipsoid")));
    EXPECT_FALSE(frame_of(gsd_format(), shaped(false)).grains.find("type_shapes:a"));
    EXPECT_THAT(news_of(gsd_format(), shaped(false)), tells({"ConvexPolyhedron, Ellipsoid"}));
}

TEST(Gsd, WithoutDiametersThereIsNoneUnlessShapesHaveThem) {
    GsdBytes gsd;
    gsd.chunk(0, "particles/N", 1, Counts{2});
    gsd.chunk(0, "particles/position", 3, Floats{1, 2, 3, 4, 5, 6});
    EXPECT_THAT(names(frame_of(gsd_format(), gsd.bytes()).grains), ElementsAre("x", "y", "z"));
    gsd.chunk(0, "particles/typeid", 1, Counts{1, 0});
    gsd.text(0, "particles/types", {"A", "B"});
    gsd.text(0, "particles/type_shapes",
             {"{\"type\": \"Sphere\", \"diameter\": 0.5}", "{\"type\": \"Polygon\"}"});
    EXPECT_THAT(column(frame_of(gsd_format(), gsd.bytes()).grains, "diameter"),
                ElementsAre(testing::IsNan(), 0.5));
}

TEST(Gsd, TwoDimensionsAreTold) {
    GsdBytes gsd = bed();
    gsd.chunk(0, "configuration/dimensions", 1, std::vector<std::uint8_t>{2});
    const OneFile file(gsd.bytes());
    EXPECT_EQ(gsd_format().open(file.path())->facts().dimensions, 2);
}

TEST(Gsd, AnotherSchemaIsRefusedByName) {
    GsdBytes gsd = bed();
    gsd.schema = "grains";
    EXPECT_THAT(complaint_of(gsd_format(), gsd.bytes()),
                tells({"schema \"grains\"", "not read", "\"hoomd\""}));
}

TEST(Gsd, ChunksOutsideOrOverOthersAreRefused) {
    GsdBytes outside = bed(), over = bed(), huge = bed(), late = bed();
    outside.last_place() = 1 << 20;
    over.last_place() = 256;
    huge.last_rows() = std::uint64_t{1} << 60;
    late.last_frame() = std::uint64_t{1} << 50;
    EXPECT_THAT(complaint_of(gsd_format(), outside.bytes()), HasSubstr("lies outside of the file"));
    EXPECT_THAT(complaint_of(gsd_format(), over.bytes()),
                tells({"byte 256", "two chunks", "over each other"}));
    EXPECT_THAT(complaint_of(gsd_format(), huge.bytes()), HasSubstr("lies outside of the file"));
    EXPECT_THAT(complaint_of(gsd_format(), late.bytes()), HasSubstr("a chunk is of frame"));
}

TEST(Gsd, WrongCountsAreRefused) {
    GsdBytes few = bed(), none, typed = bed();
    few.chunk(2, "particles/velocity", 3, Floats{1, 2, 3});
    none.chunk(0, "particles/N", 1, Counts{1000000000});
    typed.chunk(2, "particles/typeid", 1, Counts{0, 1, 2});
    EXPECT_THAT(complaint_of(gsd_format(), few.bytes()), tells({"1 rows", "3 grains"}));
    EXPECT_THAT(complaint_of(gsd_format(), none.bytes()), HasSubstr("no places"));
    EXPECT_THAT(complaint_of(gsd_format(), typed.bytes()), tells({"type 2", "2 types"}));
    GsdBytes nan;
    nan.chunk(0, "particles/N", 1, Counts{1});
    nan.chunk(0, "particles/position", 3, Floats{1, NAN, 2});
    EXPECT_THAT(complaint_of(gsd_format(), nan.bytes()), tells({"grain 0", "frame 0", "no place"}));
}

TEST(Gsd, EveryCutIsRefused) {
    const std::string bytes = bed().bytes();
    for (std::size_t size = 8; size + 64 < bytes.size(); size += 5)
        EXPECT_NE(complaint_of(gsd_format(), bytes.substr(0, size)), "no complaint") << size;
}

// Whatever value a byte has, the file is read or refused.
TEST(Gsd, AnyByteMayBeWrong) {
    const std::string bytes = bed().bytes();
    for (std::size_t at = 8; at < bytes.size(); at += 3) {
        std::string wrong = bytes;
        wrong[at] = static_cast<char>(wrong[at] ^ 0xff);
        complaint_of(gsd_format(), wrong);
    }
}

}  // namespace
}  // namespace grainreel
