// Tests of trajectory.nc and contacts.nc: they are written and read, continued, cut off and damaged.
#include "engine/files/trajectory/trajectory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netcdf.h>

#include <array>
#include <cmath>
#include <thread>

#include "engine/base/error.hpp"
#include "engine/files/contacts_file.hpp"
#include "engine/files/netcdf/netcdf_file.hpp"
#include "tests/cli/made_frame.hpp"
#include "tests/support/tells.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using test::tells;

using test::made_frame, test::TemporaryFolder, test::vector_of;

TrajectoryInfo made_info(std::size_t capacity, bool orientation = false) {
    TrajectoryInfo info;
    info.title = "A test";
    info.program_version = "1.2.3";
    info.species = {"small ones", "big", "glued"};
    info.capacity = capacity;
    info.orientation = orientation;
    info.cell.origin = {-0.1, -0.2, 0};
    info.cell.length = {0.2, 0, 0};
    return info;
}

// The numbers go through memory, because GCC 12 at -O3 would leave out the rounding of a vector to floats and
// back.
Vec3 as_floats(const Vec3& v) {
    Vec3 rounded;
    for (int k = 0; k < 3; ++k) {
        const volatile float single = static_cast<float>(v[k]);
        rounded[k] = single;
    }
    return rounded;
}

// Compares bit by bit, except for numbers that the file keeps as floats.
void expect_same(const State& got, const State& wanted) {
    EXPECT_EQ(got.step, wanted.step);
    EXPECT_EQ(got.time, wanted.time);
    EXPECT_EQ(got.cycles, wanted.cycles);
    EXPECT_EQ(got.phase, wanted.phase);
    EXPECT_EQ(got.bodies, wanted.bodies);
    EXPECT_EQ(got.id, wanted.id);
    EXPECT_EQ(got.species, wanted.species);
    EXPECT_EQ(got.radius, wanted.radius);
    EXPECT_EQ(got.position, wanted.position);
    ASSERT_EQ(got.velocity.size(), wanted.size());
    ASSERT_EQ(got.spin.size(), wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        EXPECT_EQ(got.velocity[i], as_floats(wanted.velocity[i]));
        EXPECT_EQ(got.spin[i], as_floats(wanted.spin[i]));
    }
    EXPECT_EQ(got.contact_number, wanted.contact_number);
    ASSERT_EQ(got.orientation.size(), wanted.orientation.size());
    for (std::size_t i = 0; i < wanted.orientation.size(); ++i) {
        EXPECT_TRUE(got.orientation[i].coeffs().isApprox(wanted.orientation[i].coeffs(), 1e-6));
    }
}

State with_contact_numbers(State frame) {
    for (std::size_t i = 0; i < frame.size(); ++i)
        frame.contact_number.push_back(static_cast<std::int32_t>(i * i));
    return frame;
}

TEST(Trajectory, ReadsBackContactNumbers) {
    const TemporaryFolder here;
    TrajectoryInfo info = made_info(5);
    info.contact_numbers = true;
    {
        TrajectoryWriter writer(here / "t.nc", info);
        for (int i = 0; i < 3; ++i) writer.write(with_contact_numbers(made_frame(5 - i, i)));
    }
    const TrajectoryReader reader(here / "t.nc");
    EXPECT_TRUE(reader.info().contact_numbers);
    for (std::size_t i = 0; i < 3; ++i)
        expect_same(reader.read(i),
                    with_contact_numbers(made_frame(5 - static_cast<int>(i), static_cast<int>(i))));
}

// The file of an earlier version is continued without contact numbers.
TEST(Trajectory, AFileWithoutContactNumbersGoesOnWithoutThem) {
    const TemporaryFolder here;
    TrajectoryInfo info = made_info(5);
    TrajectoryWriter(here / "t.nc", info).write(made_frame(5, 0));
    info.contact_numbers = true;
    TrajectoryWriter(here / "t.nc", info, 1).write(with_contact_numbers(made_frame(5, 1)));
    const TrajectoryReader reader(here / "t.nc");
    ASSERT_EQ(reader.frames(), 2u);
    EXPECT_FALSE(reader.info().contact_numbers);
    expect_same(reader.read(1), made_frame(5, 1));
}

TEST(Trajectory, ReadsBackWhatWasWritten) {
    const TemporaryFolder here;
    {
        TrajectoryWriter writer(here / "t.nc", made_info(5, true));
        for (int i = 0; i < 3; ++i) writer.write(made_frame(5, i, true));
        EXPECT_EQ(writer.frames(), 3);
    }
    const TrajectoryReader reader(here / "t.nc");
    ASSERT_EQ(reader.frames(), 3u);
    EXPECT_EQ(reader.info().title, "A test");
    EXPECT_EQ(reader.info().species, made_info(5).species);
    EXPECT_EQ(reader.info().cell, made_info(5).cell);
    for (std::size_t i = 0; i < 3; ++i) expect_same(reader.read(i), made_frame(5, static_cast<int>(i), true));
}

// Container and floor have variables of their own; all other bodies share a dimension.
TEST(Trajectory, SaysWhereAllBodiesAre) {
    const TemporaryFolder here;
    TrajectoryInfo info = made_info(2);
    info.bodies = {"paddle", "sieve"};
    State frame = made_frame(2, 1);
    for (const double seed : {5.1, 6.2})
        frame.bodies.push_back({vector_of(seed), Quaternion(seed, 1, -2, 0.3).normalized(),
                                vector_of(2 * seed), vector_of(3 * seed)});
    TrajectoryWriter(here / "t.nc", info).write(frame);
    const TrajectoryReader reader(here / "t.nc");
    EXPECT_EQ(reader.info().bodies, info.bodies);
    expect_same(reader.read(0), frame);
    EXPECT_EQ(reader.read_moment(0).bodies, frame.bodies);
}

TEST(Trajectory, ABodyThatNoRunHasIsDamage) {
    const TemporaryFolder here;
    TrajectoryInfo info = made_info(2);
    info.bodies = {"paddle"};
    const auto writes = [&](const BodyPose& pose) {
        State frame = made_frame(2, 1);
        frame.bodies.push_back(pose);
        TrajectoryWriter(here / "t.nc", info).write(frame);
        return TrajectoryReader(here / "t.nc");
    };
    EXPECT_NO_THROW(writes({}).read(0));
    EXPECT_THROW(writes({Vec3(0, NAN, 0), {1, 0, 0, 0}, {0, 0, 0}, {0, 0, 0}}).read(0), DamagedFrame);
    EXPECT_THROW(writes({Vec3(0, 0, 0), {0.9, 0, 0, 0}, {0, 0, 0}, {0, 0, 0}}).read(0), DamagedFrame);
    EXPECT_THROW(writes({Vec3(0, 0, 0), {1, 0, 0, 0}, {0, 0, 0}, {0, INFINITY, 0}}).read(0), DamagedFrame);
}

// A tetrahedron and a square of two triangles.
std::vector<TrajectoryMesh> made_meshes() {
    return {
        {2,
         {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1.0 / 3}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}}},
        {4, {{{0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}}, {{0, 1, 2}, {0, 2, 3}}}}};
}

State with_bodies(State frame, int bodies) {
    for (int b = 0; b < bodies; ++b)
        frame.bodies.push_back({vector_of(b + 1), Quaternion(b + 1, 1, -2, 0.3).normalized(),
                                vector_of(2 * b), vector_of(3 * b)});
    return frame;
}

// The file has the shape once, at rest, and its place in every frame.
TEST(Trajectory, KeepsTheShapesOfMeshes) {
    const TemporaryFolder here;
    TrajectoryInfo info = made_info(2);
    info.bodies = {"drum", "plane", "vane"};
    info.meshes = made_meshes();
    {
        TrajectoryWriter writer(here / "t.nc", info);
        for (const int i : {1, 2}) writer.write(with_bodies(made_frame(2, i), 3));
    }
    const TrajectoryReader reader(here / "t.nc");
    EXPECT_EQ(reader.info().bodies, info.bodies);
    ASSERT_EQ(reader.info().meshes.size(), 2u);
    for (std::size_t m = 0; m < 2; ++m) {
        EXPECT_EQ(reader.info().meshes[m].body, info.meshes[m].body);
        EXPECT_EQ(reader.info().meshes[m].shape.vertices, info.meshes[m].shape.vertices);
        EXPECT_EQ(reader.info().meshes[m].shape.triangles, info.meshes[m].shape.triangles);
    }
    expect_same(reader.read(1), with_bodies(made_frame(2, 2), 3));
    EXPECT_FALSE(reader.info().container_turns);
}

TEST(Trajectory, GoesOnOnlyWithTheSameMeshes) {
    const TemporaryFolder here;
    TrajectoryInfo info = made_info(2);
    info.bodies = {"drum", "plane", "vane"};
    info.meshes = made_meshes();
    TrajectoryWriter(here / "t.nc", info).write(with_bodies(made_frame(2, 1), 3));
    EXPECT_TRUE(TrajectoryWriter::goes_on_with(info, here / "t.nc"));
    info.meshes[0].shape.vertices[3].z() += 1e-12;
    EXPECT_THROW(TrajectoryWriter::goes_on_with(info, here / "t.nc"), UserError);
    info.meshes.pop_back();
    EXPECT_THROW(TrajectoryWriter::goes_on_with(info, here / "t.nc"), UserError);
}

TEST(Trajectory, SaysHowFarTheContainerHasTurned) {
    const TemporaryFolder here;
    TrajectoryInfo info = made_info(2);
    info.container_turns = true;
    State frame = made_frame(2, 1);
    frame.container().rotation = Quaternion(1, 2, 3, 4).normalized();
    frame.floor().rotation = Quaternion(4, -3, 2, 1).normalized();
    frame.container().spin = {1, 2, 3}, frame.floor().spin = {-1, 0.5, 7};
    TrajectoryWriter(here / "t.nc", info).write(frame);
    const TrajectoryReader reader(here / "t.nc");
    EXPECT_TRUE(reader.info().container_turns);
    expect_same(reader.read(0), frame);
}

// Optional variables must not change a file that does not have them.
TEST(Trajectory, AFileWithoutMeshesHasNoneOfTheirVariables) {
    const TemporaryFolder here;
    TrajectoryWriter(here / "t.nc", made_info(2)).write(made_frame(2, 1));
    int file = -1, variable = -1;
    ASSERT_EQ(nc_open((here / "t.nc").c_str(), NC_NOWRITE, &file), NC_NOERR);
    for (const char* name : {"mesh_body", "vertices", "triangles", "wall_rotation", "body_place"})
        EXPECT_EQ(nc_inq_varid(file, name, &variable), NC_ENOTVAR) << name;
    nc_close(file);
}

// Each part of the shapes is damaged in turn: a vertex, a count, a corner.
TEST(Trajectory, DamagedShapesAreRefused) {
    const TemporaryFolder here;
    TrajectoryInfo info = made_info(2);
    info.bodies = {"drum", "plane", "vane"};
    info.meshes = made_meshes();
    const auto damaged = [&](const char* name, std::size_t at, int to) {
        TrajectoryWriter(here / "t.nc", info).write(with_bodies(made_frame(2, 1), 3));
        int file = -1, variable = -1;
        nc_open((here / "t.nc").c_str(), NC_WRITE, &file);
        EXPECT_EQ(nc_inq_varid(file, name, &variable), NC_NOERR) << name;
        const std::size_t second = 0;
        const std::array<std::size_t, 2> place{at, second};
        EXPECT_EQ(nc_put_var1_int(file, variable, place.data(), &to), NC_NOERR);
        nc_close(file);
        return here / "t.nc";
    };
    EXPECT_NO_THROW(TrajectoryReader(damaged("mesh_body", 0, 2)));
    EXPECT_THROW(TrajectoryReader(damaged("mesh_body", 0, 3)), UserError);
    EXPECT_THROW(TrajectoryReader(damaged("mesh_vertices", 1, 1000000000)), UserError);
    EXPECT_THROW(TrajectoryReader(damaged("mesh_triangles", 0, -1)), UserError);
    EXPECT_THROW(TrajectoryReader(damaged("vertices", 3, 7)), UserError);
    EXPECT_THROW(TrajectoryReader(damaged("triangles", 2, 3)), UserError);
}

TEST(Trajectory, GrainsMayComeAndGo) {
    const TemporaryFolder here;
    {
        TrajectoryWriter writer(here / "t.nc", made_info(7));
        writer.write(made_frame(3, 0));
        writer.write(made_frame(7, 1));
        writer.write(made_frame(0, 2));
    }
    const TrajectoryReader reader(here / "t.nc");
    expect_same(reader.read(0), made_frame(3, 0));
    expect_same(reader.read(1), made_frame(7, 1));
    expect_same(reader.read(2), made_frame(0, 2));
}

// A frame of grains with these ids, at places that no other frame has.
State frame_with(const std::vector<std::int32_t>& ids, int number) {
    State frame = made_frame(static_cast<int>(ids.size()), number, true);
    frame.id = ids;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        frame.species[i] = ids[i] % 3;
        frame.radius[i] = 1e-3 * (1 + ids[i]);
    }
    return frame;
}

// The shapes follow their grains where grains come and go.
TEST(Trajectory, KeepsTheShapesOfGrains) {
    const TemporaryFolder here;
    TrajectoryInfo info = made_info(6, true);
    info.shapes = info.traffic = true;
    const auto shaped = [](const std::vector<std::int32_t>& ids, int number) {
        State frame = frame_with(ids, number);
        for (const std::int32_t id : ids)
            frame.shape.push_back({Vec3(1, 2, 0.5) * (1 + id), 2.0 + id, 2.0 + 0.5 * id});
        return frame;
    };
    const std::vector<State> frames{shaped({0, 1, 2}, 0), shaped({0, 2, 5}, 1)};
    {
        TrajectoryWriter writer(here / "t.nc", info);
        for (const State& frame : frames) writer.write(frame);
    }
    const TrajectoryReader reader(here / "t.nc");
    EXPECT_TRUE(reader.info().shapes);
    for (std::size_t f = 0; f < frames.size(); ++f) {
        const State got = reader.read(f);
        expect_same(got, frames[f]);
        ASSERT_EQ(got.shape.size(), frames[f].size());
        for (std::size_t i = 0; i < got.size(); ++i) {
            EXPECT_EQ(got.shape[i].half, frames[f].shape[i].half);
            EXPECT_EQ(got.shape[i].along, frames[f].shape[i].along);
            EXPECT_EQ(got.shape[i].around, frames[f].shape[i].around);
        }
    }
}

// A grain that has gone keeps its place in the file, and a new grain gets the next one. In a place without a
// grain stands one in the container's lowest corner, too small to be seen.
TEST(Trajectory, EveryGrainKeepsItsPlaceWhereSomeComeAndGo) {
    const TemporaryFolder here;
    const std::vector<State> frames{frame_with({0, 1, 2, 5}, 0), frame_with({0, 2, 5}, 1),
                                    frame_with({0, 5, 6}, 2), frame_with({}, 3), frame_with({8}, 4)};
    TrajectoryInfo info = made_info(6, true);
    info.traffic = true;
    {
        TrajectoryWriter writer(here / "t.nc", info);
        for (const State& frame : frames) writer.write(frame);
        EXPECT_THROW(writer.write(frame_with({9}, 5)), RunError) << "a seventh grain";
    }
    const TrajectoryReader reader(here / "t.nc");
    EXPECT_TRUE(reader.info().traffic);
    ASSERT_EQ(reader.frames(), frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) expect_same(reader.read(i), frames[i]);

    int file = -1, variable = -1;
    ASSERT_EQ(nc_open((here / "t.nc").c_str(), NC_NOWRITE, &file), NC_NOERR);
    std::array<std::array<int, 6>, 5> present{}, id{};
    std::array<std::array<double, 18>, 5> x{};
    std::array<std::array<float, 18>, 5> v{};
    std::array<std::array<double, 6>, 5> radius{};
    ASSERT_EQ(nc_inq_varid(file, "present", &variable), NC_NOERR);
    ASSERT_EQ(nc_get_var_int(file, variable, present[0].data()), NC_NOERR);
    ASSERT_EQ(nc_inq_varid(file, "id", &variable), NC_NOERR);
    ASSERT_EQ(nc_get_var_int(file, variable, id[0].data()), NC_NOERR);
    ASSERT_EQ(nc_inq_varid(file, "coordinates", &variable), NC_NOERR);
    ASSERT_EQ(nc_get_var_double(file, variable, x[0].data()), NC_NOERR);
    ASSERT_EQ(nc_inq_varid(file, "velocities", &variable), NC_NOERR);
    ASSERT_EQ(nc_get_var_float(file, variable, v[0].data()), NC_NOERR);
    ASSERT_EQ(nc_inq_varid(file, "radius", &variable), NC_NOERR);
    ASSERT_EQ(nc_get_var_double(file, variable, radius[0].data()), NC_NOERR);
    nc_close(file);
    EXPECT_THAT(present[0], testing::ElementsAre(1, 1, 1, 1, 0, 0));
    EXPECT_THAT(present[1], testing::ElementsAre(1, 0, 1, 1, 0, 0));
    EXPECT_THAT(present[2], testing::ElementsAre(1, 0, 0, 1, 1, 0));
    EXPECT_THAT(present[3], testing::ElementsAre(0, 0, 0, 0, 0, 0));
    EXPECT_THAT(present[4], testing::ElementsAre(0, 0, 0, 0, 0, 1));
    EXPECT_THAT(id[1], testing::ElementsAre(0, 1, 2, 5, -1, -1));
    EXPECT_THAT(id[4], testing::ElementsAre(0, 1, 2, 5, 6, 8));
    for (std::size_t frame = 0; frame < 5; ++frame)
        for (std::size_t place = 0; place < 6; ++place) {
            const bool here_now = present[frame][place] != 0;
            EXPECT_EQ(radius[frame][place] == kAbsentRadius, !here_now) << frame << " " << place;
            for (std::size_t k = 0; k < 3; ++k) {
                const bool corner = x[frame][3 * place + k] == info.cell.origin[static_cast<int>(k)];
                EXPECT_EQ(corner, !here_now) << frame << " " << place;
                if (!here_now) {
                    EXPECT_EQ(v[frame][3 * place + k], 0);
                }
            }
        }
}

// Files of earlier versions have fill values where no grain has been; a grain that has gone stays at its last
// place.
TEST(Trajectory, FilesOfEarlierVersionsAreRead) {
    const TemporaryFolder here;
    TrajectoryInfo info = made_info(4);
    info.traffic = true;
    const std::vector<State> frames{frame_with({0, 1, 2}, 0), frame_with({0, 2}, 1)};
    {
        TrajectoryWriter writer(here / "t.nc", info);
        for (State frame : frames) writer.write(frame);
    }
    int file = -1, variable = -1;
    ASSERT_EQ(nc_open((here / "t.nc").c_str(), NC_WRITE, &file), NC_NOERR);
    for (const char* name : {"coordinates", "radius"}) {
        const std::size_t width = *name == 'c' ? 3 : 1;
        ASSERT_EQ(nc_inq_varid(file, name, &variable), NC_NOERR);
        const std::vector<double> fill(2 * width, NC_FILL_DOUBLE);
        const std::array<std::size_t, 3> never{1, 3, 0}, gone{1, 1, 0}, count{1, 1, width};
        ASSERT_EQ(nc_put_vara_double(file, variable, never.data(), count.data(), fill.data()), NC_NOERR);
        const std::vector<double> last(width, 0.004);
        ASSERT_EQ(nc_put_vara_double(file, variable, gone.data(), count.data(), last.data()), NC_NOERR);
    }
    // Files of earlier versions had the right checksums, and those of this file are wrong now. So they are
    // renamed, because a file without checksums is read as it is.
    ASSERT_EQ(nc_inq_varid(file, "grain_checksum", &variable), NC_NOERR);
    ASSERT_EQ(nc_rename_var(file, variable, "grain_nothing"), NC_NOERR);
    nc_close(file);
    const TrajectoryReader reader(here / "t.nc");
    for (std::size_t i = 0; i < frames.size(); ++i) {
        State wanted = frames[i];
        wanted.orientation.clear();
        expect_same(reader.read(i), wanted);
    }
}

// No run writes such flags, but somebody's program may.
TEST(Trajectory, FlagsThatDoNotMatchTheCountAreDamage) {
    const TemporaryFolder here;
    TrajectoryInfo info = made_info(3, true);
    info.traffic = true;
    TrajectoryWriter(here / "t.nc", info).write(frame_with({0, 1}, 0));
    int file = -1, variable = -1;
    ASSERT_EQ(nc_open((here / "t.nc").c_str(), NC_WRITE, &file), NC_NOERR);
    ASSERT_EQ(nc_inq_varid(file, "present", &variable), NC_NOERR);
    const std::array<int, 3> one{1, 0, 0};
    ASSERT_EQ(nc_put_var_int(file, variable, one.data()), NC_NOERR);
    nc_close(file);
    EXPECT_THROW(TrajectoryReader(here / "t.nc").read(0), DamagedFrame);
}

TEST(Trajectory, PlacesWithoutAGrainAreInTheLowestCorner) {
    const TemporaryFolder here;
    TrajectoryWriter(here / "t.nc", made_info(3)).write(made_frame(2, 0));
    int file = -1, variable = -1;
    ASSERT_EQ(nc_open((here / "t.nc").c_str(), NC_NOWRITE, &file), NC_NOERR);
    std::array<double, 9> x{};
    ASSERT_EQ(nc_inq_varid(file, "coordinates", &variable), NC_NOERR);
    ASSERT_EQ(nc_get_var_double(file, variable, x.data()), NC_NOERR);
    for (std::size_t k = 0; k < 6; ++k)
        EXPECT_EQ(x[k], made_frame(2, 0).position[k / 3][static_cast<int>(k % 3)]);
    for (std::size_t k = 6; k < 9; ++k) EXPECT_EQ(x[k], made_info(3).cell.origin[static_cast<int>(k % 3)]);
    std::array<int, 3> id{};
    ASSERT_EQ(nc_inq_varid(file, "id", &variable), NC_NOERR);
    ASSERT_EQ(nc_get_var_int(file, variable, id.data()), NC_NOERR);
    EXPECT_THAT(id, testing::ElementsAre(1, 3, -1));
    nc_close(file);
}

TEST(Trajectory, TooManyGrainsForTheFileIsARunError) {
    const TemporaryFolder here;
    TrajectoryWriter writer(here / "t.nc", made_info(4));
    EXPECT_THROW(writer.write(made_frame(5, 0)), RunError);
}

TEST(Trajectory, FollowsTheAmberConvention) {
    const TemporaryFolder here;
    TrajectoryWriter(here / "t.nc", made_info(4)).write(made_frame(4, 0));
    EXPECT_EQ(test::text_of(here / "t.nc").substr(0, 4), "CDF\2");
    int file = -1;
    ASSERT_EQ(nc_open((here / "t.nc").c_str(), NC_NOWRITE, &file), NC_NOERR);
    const auto attribute = [&](int variable, const char* name) {
        std::size_t length = 0;
        EXPECT_EQ(nc_inq_attlen(file, variable, name, &length), NC_NOERR) << name;
        std::string text(length, ' ');
        nc_get_att_text(file, variable, name, text.data());
        return text;
    };
    EXPECT_EQ(attribute(NC_GLOBAL, "Conventions"), "AMBER");
    EXPECT_EQ(attribute(NC_GLOBAL, "ConventionVersion"), "1.0");
    EXPECT_EQ(attribute(NC_GLOBAL, "program"), "grainreel");
    EXPECT_EQ(attribute(NC_GLOBAL, "programVersion"), "1.2.3");
    const std::vector<std::pair<const char*, std::vector<std::string>>> shapes = {
        {"spatial", {"spatial"}},
        {"cell_spatial", {"cell_spatial"}},
        {"cell_angular", {"cell_angular", "label"}},
        {"time", {"frame"}},
        {"coordinates", {"frame", "atom", "spatial"}},
        {"velocities", {"frame", "atom", "spatial"}},
        {"cell_lengths", {"frame", "cell_spatial"}},
        {"cell_angles", {"frame", "cell_angular"}},
        {"radius", {"frame", "atom"}}};
    for (const auto& [name, dimensions] : shapes) {
        int variable = -1, rank = 0;
        std::array<int, NC_MAX_VAR_DIMS> ids{};
        ASSERT_EQ(nc_inq_varid(file, name, &variable), NC_NOERR) << name;
        nc_inq_var(file, variable, nullptr, nullptr, &rank, ids.data(), nullptr);
        ASSERT_EQ(rank, static_cast<int>(dimensions.size())) << name;
        for (std::size_t d = 0; d < dimensions.size(); ++d) {
            std::array<char, NC_MAX_NAME + 1> dimension{};
            nc_inq_dimname(file, ids[d], dimension.data());
            EXPECT_EQ(dimension.data(), dimensions[d]) << name;
        }
    }
    int coordinates = -1;
    nc_inq_varid(file, "coordinates", &coordinates);
    EXPECT_EQ(attribute(coordinates, "units"), "meter");
    nc_close(file);
}

// Another process reads now what the program would leave if it were killed now.
TEST(Trajectory, IsReadableWhileItIsBeingWritten) {
    const TemporaryFolder here;
    TrajectoryWriter writer(here / "t.nc", made_info(4));
    EXPECT_EQ(TrajectoryReader(here / "t.nc").frames(), 0u);
    for (int i = 0; i < 4; ++i) {
        writer.write(made_frame(4, i));
        std::filesystem::copy_file(here / "t.nc", here / "copy.nc",
                                   std::filesystem::copy_options::overwrite_existing);
        const TrajectoryReader reader(here / "copy.nc");
        ASSERT_EQ(reader.frames(), static_cast<std::size_t>(i + 1));
        expect_same(reader.read(static_cast<std::size_t>(i)), made_frame(4, i));
    }
}

TEST(Trajectory, OtherFilesAreUserErrors) {
    const TemporaryFolder here;
    EXPECT_THROW(TrajectoryReader(here / "missing.nc"), UserError);
    test::write_text(here / "text.nc", "not NetCDF at all");
    EXPECT_THROW(TrajectoryReader(here / "text.nc"), UserError);
}

std::string mistake_in(const std::filesystem::path& path) {
    try {
        const TrajectoryReader reader(path);
        return "none";
    } catch (const UserError& error) {
        return error.what();
    }
}

TEST(Trajectory, AForeignFileIsToldWhatItLacks) {
    const TemporaryFolder here;
    int file = -1, frame = -1, atom = -1, variable = -1;
    ASSERT_EQ(nc_create((here / "other.nc").c_str(), NC_CLOBBER, &file), NC_NOERR);
    nc_def_dim(file, "frame", NC_UNLIMITED, &frame);
    nc_def_dim(file, "atom", 3, &atom);
    for (const char* name :
         {"time", "step", "grains", "id", "type", "radius", "coordinates", "velocities", "spin"})
        nc_def_var(file, name, NC_DOUBLE, 1, &frame, &variable);
    nc_close(file);
    EXPECT_EQ(mistake_in(here / "other.nc"),
              (here / "other.nc").string() +
                  ": not a trajectory of grainreel: it lacks cycles, phase, wall_offset, wall_velocity, "
                  "floor_offset, floor_velocity, cell_origin, cell_lengths, cell_angles; give the "
                  "trajectory.nc of a run");
}

// A file with three frames of 200 grains.
std::string three_frames(const TemporaryFolder& here) {
    {
        TrajectoryWriter writer(here / "t.nc", made_info(200, true));
        for (int i = 0; i < 3; ++i) writer.write(made_frame(200, i, true));
    }
    EXPECT_EQ(mistake_in(here / "t.nc"), "none");
    return test::text_of(here / "t.nc");
}

// A killed run leaves such a frame. The library reads zeros beyond the end, so even one missing byte must be
// noticed.
TEST(Trajectory, ALastFrameThatIsNotWholeIsLeftOut) {
    const TemporaryFolder here;
    const std::string whole = three_frames(here);
    EXPECT_FALSE(TrajectoryReader(here / "t.nc").cut_off());
    for (const std::size_t cut : {1, 600, 9000}) {
        test::write_old_text(here / "cut.nc", whole.substr(0, whole.size() - cut));
        const TrajectoryReader reader(here / "cut.nc");
        EXPECT_TRUE(reader.cut_off()) << cut;
        ASSERT_EQ(reader.frames(), 2u) << cut;
        EXPECT_EQ(reader.read(1).position, made_frame(200, 1, true).position) << cut;
    }
}

TEST(Trajectory, AFileThatWasCutOffIsAUserError) {
    const TemporaryFolder here;
    const std::string whole = three_frames(here);
    const std::size_t record = (whole.size() - 1) / 3;  // includes a part of the header
    test::write_old_text(here / "cut.nc", whole.substr(0, whole.size() - record));
    EXPECT_THAT(mistake_in(here / "cut.nc"), tells({"cut.nc", "cut off", "3 frames 1"}));
}

// A run that continues in the file corrects the count.
TEST(Trajectory, ItIsWrittenOnBehindTheLastWholeFrame) {
    const TemporaryFolder here;
    const std::string whole = three_frames(here);
    for (const std::size_t cut : {0, 1, 9000}) {
        test::write_old_text(here / "cut.nc", whole.substr(0, whole.size() - cut));
        TrajectoryWriter(here / "cut.nc", made_info(200, true), 2).write(made_frame(200, 2, true));
        EXPECT_EQ(test::text_of(here / "cut.nc") == whole, true) << cut;
    }
}

// The library counts a frame shortly before it writes it.
TEST(Trajectory, AFrameThatIsOnItsWayIsWaitedFor) {
    const TemporaryFolder here;
    {
        TrajectoryWriter writer(here / "t.nc", made_info(20));
        for (int i = 0; i < 3; ++i) writer.write(made_frame(20, i));
    }
    const std::string whole = test::text_of(here / "t.nc");
    test::write_text(here / "half.nc", whole.substr(0, whole.size() - 600));
    std::thread writer([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        std::ofstream(here / "half.nc", std::ios::app | std::ios::binary) << whole.substr(whole.size() - 600);
    });
    EXPECT_EQ(mistake_in(here / "half.nc"), "none");
    writer.join();
}

TEST(Trajectory, AMomentIsAFrameWithoutGrains) {
    const TemporaryFolder here;
    TrajectoryWriter(here / "t.nc", made_info(5)).write(made_frame(5, 4));
    const State moment = TrajectoryReader(here / "t.nc").read_moment(0), wanted = made_frame(5, 4);
    EXPECT_EQ(moment.step, wanted.step);
    EXPECT_EQ(moment.time, wanted.time);
    EXPECT_EQ(moment.phase, wanted.phase);
    EXPECT_EQ(moment.container().place, wanted.container().place);
    EXPECT_EQ(moment.size(), 0u);
}

// The header is compared with what the library writes, in each of the classic formats.
TEST(NetcdfHeader, IsWhatLiesOnDisk) {
    const TemporaryFolder here;
    for (const int format : {0, NC_64BIT_OFFSET, NC_64BIT_DATA}) {
        for (const int columns : {1, 3}) {
            const std::filesystem::path path = here / "layout.nc";
            int file = -1, rows = -1, width = -1, fixed = -1;
            ASSERT_EQ(nc_create(path.c_str(), NC_CLOBBER | format, &file), NC_NOERR);
            nc_def_dim(file, "row", NC_UNLIMITED, &rows);
            nc_def_dim(file, "width", 5, &width);
            nc_def_var(file, "a_fixed_one", NC_SHORT, 1, &width, &fixed);
            nc_put_att_text(file, fixed, "units", 7, "furlong");
            nc_put_att_text(file, NC_GLOBAL, "title", 9, "a layout!");
            const std::array<int, 2> dimensions = {rows, width};
            std::vector<int> variables(static_cast<std::size_t>(columns));
            for (int i = 0; i < columns; ++i)
                nc_def_var(file, ("column_" + std::to_string(i)).c_str(), i == 1 ? NC_BYTE : NC_SHORT, 2,
                           dimensions.data(), &variables[static_cast<std::size_t>(i)]);
            nc_enddef(file);
            const std::array<std::size_t, 2> start = {0, 0}, count = {4, 5};
            const std::vector<int> values(20, 7);
            for (const int variable : variables)
                ASSERT_EQ(nc_put_vara_int(file, variable, start.data(), count.data(), values.data()),
                          NC_NOERR);
            nc_close(file);
            const NetcdfHeader header = read_netcdf_header(path);
            EXPECT_EQ(header.record, columns == 1 ? 10u : 12u + 8u + 12u) << format;
            EXPECT_EQ(header.begin + 4 * header.record, std::filesystem::file_size(path))
                << format << ", columns " << columns;
        }
    }
}

TEST(Trajectory, AFileThatCannotBeMadeIsARunError) {
    EXPECT_THROW(TrajectoryWriter("/dev/null/t.nc", made_info(4)), RunError);
}

TEST(ContactsFile, IsATableWithTheFrameOfEveryRow) {
    const TemporaryFolder here;
    const auto contact = [](int i) {
        return SavedContact{i, -1 - i, i + 0.5, vector_of(i), vector_of(i + 0.5)};
    };
    {
        ContactsWriter writer(here / "c.nc", "A test", "1.2.3");
        writer.write(0, {contact(0), contact(1)});
        writer.write(1, {});
        writer.write(2, {contact(2)});
    }
    int file = -1;
    ASSERT_EQ(nc_open((here / "c.nc").c_str(), NC_NOWRITE, &file), NC_NOERR);
    const auto column = [&](const char* name, std::size_t width) {
        int variable = -1;
        EXPECT_EQ(nc_inq_varid(file, name, &variable), NC_NOERR) << name;
        std::size_t rows = 0;
        nc_inq_dimlen(file, 0, &rows);
        EXPECT_EQ(rows, 3u);
        std::vector<double> values(rows * width);
        nc_get_var_double(file, variable, values.data());
        return values;
    };
    EXPECT_THAT(column("frame", 1), testing::ElementsAre(0, 0, 2));
    EXPECT_THAT(column("first", 1), testing::ElementsAre(0, 1, 2));
    EXPECT_THAT(column("second", 1), testing::ElementsAre(-1, -2, -3));
    EXPECT_THAT(column("normal", 1), testing::ElementsAre(0.5, 1.5, 2.5));
    const std::vector<double> tangential = column("tangential", 3), point = column("point", 3);
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            const auto at = static_cast<std::size_t>(3 * i + k);
            EXPECT_EQ(tangential[at], static_cast<float>(vector_of(i)[k]));
            EXPECT_EQ(point[at], static_cast<float>(vector_of(i + 0.5)[k]));
        }
    }
    nc_close(file);
}

TEST(ContactsFile, HasTheTorqueOfTheResistanceToRolling) {
    const TemporaryFolder here;
    for (const bool meshes : {false, true}) {
        const SavedContact one{3, -1, 0.5, vector_of(1), vector_of(2), meshes ? 4 : -1, vector_of(3)};
        ContactsWriter(here / "c.nc", "A test", "1.2.3", {}, meshes, true).write(0, {one});
        ContactsWriter(here / "c.nc", 1).write(1, {one});
        const ContactsReader reader(here / "c.nc");
        for (const std::size_t frame : {0U, 1U}) {
            const std::vector<SavedContact> read = reader.contacts(frame);
            ASSERT_EQ(read.size(), 1u);
            EXPECT_EQ(read[0].triangle, one.triangle);
            EXPECT_EQ(read[0].rolling, Vec3(one.rolling.cast<float>().cast<double>()));
        }
    }
}

TEST(ContactsFile, HasTheTrianglesOfMeshes) {
    const TemporaryFolder here;
    const auto touch = [](std::int32_t grain, std::int32_t triangle) {
        return SavedContact{grain, -7, 0.5, vector_of(1), vector_of(2), triangle};
    };
    {
        ContactsWriter writer(here / "c.nc", "A test", "1.2.3", {}, true);
        writer.write(0, {touch(0, 12), touch(0, 15)});
    }
    ContactsWriter(here / "c.nc", 1).write(1, {touch(3, 9), {4, 5, 1, {}, {}}});
    const ContactsReader reader(here / "c.nc");
    EXPECT_EQ(reader.touches(0).size(), 2u);  // the grain touches two parts of one mesh
    EXPECT_EQ(reader.touches(1).size(), 2u);
    int file = -1, variable = -1;
    ASSERT_EQ(nc_open((here / "c.nc").c_str(), NC_WRITE, &file), NC_NOERR);
    ASSERT_EQ(nc_inq_varid(file, "triangle", &variable), NC_NOERR);
    std::array<int, 4> triangles{};
    nc_get_var_int(file, variable, triangles.data());
    EXPECT_THAT(triangles, testing::ElementsAre(12, 15, 9, -1));
    const std::size_t row = 2;
    const int other = 10;
    nc_put_var1_int(file, variable, &row, &other);
    nc_close(file);
    EXPECT_THROW(ContactsReader(here / "c.nc").touches(1), UserError);  // the checksum of the row covers it
}

TEST(ContactsFile, IsReadFrameByFrame) {
    const TemporaryFolder here;
    {
        ContactsWriter writer(here / "c.nc", "A test", "1.2.3");
        for (const int frame : {0, 2})  // the one between them has no contact
            writer.write(frame,
                         {{frame, 7, 0.25 * frame, vector_of(0), vector_of(0)}, {frame, -3, 8, {}, {}}});
    }
    const ContactsReader reader(here / "c.nc");
    for (const int frame : {0, 2}) {
        const std::vector<Link> touches = reader.touches(static_cast<std::size_t>(frame));
        ASSERT_EQ(touches.size(), 2u);
        EXPECT_EQ(touches[0].first, frame);
        EXPECT_EQ(touches[0].second, 7);
        EXPECT_EQ(touches[0].force, 0.25 * frame);
        EXPECT_EQ(touches[1].second, -3);
        EXPECT_EQ(touches[1].force, 8);
    }
    EXPECT_TRUE(reader.touches(1).empty());
    EXPECT_TRUE(reader.touches(3).empty());
    EXPECT_THROW(ContactsReader(here / "none.nc"), UserError);
}

// Half of a frame's contacts would look like all of them.
TEST(ContactsFile, OfAFileThatWasCutOffTheLastFrameHasNone) {
    const TemporaryFolder here;
    {
        ContactsWriter writer(here / "c.nc", "A test", "1.2.3");
        for (const int frame : {0, 1, 2})
            writer.write(frame, {{frame, 7, 1, vector_of(0), vector_of(0)}, {frame, -3, 8, {}, {}}});
    }
    EXPECT_TRUE(ContactsReader(here / "c.nc").has_all(2));
    test::write_old_text(
        here / "c.nc", test::text_of(here / "c.nc").substr(0, std::filesystem::file_size(here / "c.nc") - 4));
    const ContactsReader reader(here / "c.nc");
    EXPECT_TRUE(reader.cut_off());
    EXPECT_EQ(reader.touches(1).size(), 2u);
    EXPECT_TRUE(reader.has_all(1));
    EXPECT_TRUE(reader.touches(2).empty());
    EXPECT_FALSE(reader.has_all(2));
    EXPECT_EQ(reader.rows_of_first(3), 5u);
}

}  // namespace
}  // namespace grainreel
