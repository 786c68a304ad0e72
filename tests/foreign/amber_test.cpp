// Tests of the reader of AMBER NetCDF trajectories.
#include <netcdf.h>

#include <cmath>
#include <cstdlib>

#include "engine/files/netcdf/hdf5_trial.hpp"
#include "tests/foreign/small_files.hpp"
#include "tests/support/tells.hpp"

namespace grainreel {

RawFormat amber_format();

namespace {

using namespace small_files;
using test::tells;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::size_t frames = 2, grains = 3;

// In frame f, grain i has x = 100 f + 10 i, y is 1 larger and z is 2 larger; all times 1024, so that a
// molecule is large enough for its unit.
double place(std::size_t frame, std::size_t grain, std::size_t axis) {
    return 1024 * static_cast<double>(100 * frame + 10 * grain + axis);
}

class Bed {
  public:
    // kind: kind of the file, NC_64BIT_OFFSET, NC_64BIT_DATA, NC_NETCDF4 or 0.
    explicit Bed(int kind, const char* length = "meter", const char* time = "second", bool in_group = false)
        : file_("") {
        std::filesystem::remove(file_.path());
        EXPECT_EQ(nc_create(file_.path().c_str(), kind | NC_CLOBBER, &root_), NC_NOERR);
        id_ = root_;
        if (in_group) nc_def_grp(root_, "AMBER", &id_);
        nc_def_dim(id_, "frame", NC_UNLIMITED, &frame_);
        nc_def_dim(id_, "atom", grains, &atom_);
        nc_def_dim(id_, "spatial", 3, &spatial_);
        nc_put_att_text(id_, NC_GLOBAL, "program", 6, "a test");
        const int coordinates = define("coordinates", NC_DOUBLE, {frame_, atom_, spatial_}, length);
        const int times = define("time", NC_FLOAT, {frame_}, time);
        define("cell_lengths", NC_DOUBLE, {frame_, spatial_}, length);
        define("cell_angles", NC_DOUBLE, {spatial_}, "degree");
        define("cell_origin", NC_DOUBLE, {frame_, spatial_}, length);
        const int velocities = define("velocities", NC_FLOAT, {frame_, atom_, spatial_}, "");
        const double scale = 20.455;
        nc_put_att_double(id_, velocities, "scale_factor", NC_DOUBLE, 1, &scale);
        define("radius", NC_DOUBLE, {atom_}, length);
        define("id", NC_INT, {frame_, atom_}, "");
        nc_enddef(root_);
        for (std::size_t f = 0; f < frames; ++f) {
            std::vector<double> places;
            for (std::size_t i = 0; i < grains; ++i)
                for (std::size_t k = 0; k < 3; ++k) places.push_back(place(f, i, k));
            put(coordinates, {f, 0, 0}, {1, grains, 3}, places);
            put(velocities, {f, 0, 0}, {1, grains, 3}, std::vector<double>(3 * grains, 2.0));
            put(times, {f}, {1}, {0.5 * static_cast<double>(f)});
            put(variable("cell_lengths"), {f, 0}, {1, 3}, {4, 5, 0});
            put(variable("cell_origin"), {f, 0}, {1, 3}, {-2, -1, 0});
            put(variable("id"), {f, 0}, {1, grains}, {7, 5, 3});
        }
        put(variable("cell_angles"), {0}, {3}, {90, 90, 60});
        put(variable("radius"), {0}, {grains}, {1, 2, 3});
    }
    int define(const char* name, int type, const std::vector<int>& dimensions, const std::string& units) {
        int variable = -1;
        EXPECT_EQ(
            nc_def_var(id_, name, type, static_cast<int>(dimensions.size()), dimensions.data(), &variable),
            NC_NOERR);
        if (!units.empty()) nc_put_att_text(id_, variable, "units", units.size(), units.c_str());
        return variable;
    }
    int variable(const char* name) const {
        int variable = -1;
        nc_inq_varid(id_, name, &variable);
        return variable;
    }
    void put(int variable, const std::vector<std::size_t>& start, const std::vector<std::size_t>& count,
             const std::vector<double>& values) const {
        EXPECT_EQ(nc_put_vara_double(id_, variable, start.data(), count.data(), values.data()), NC_NOERR);
    }
    // The bytes of the file. Nothing can be added to it afterwards.
    std::string bytes() {
        if (root_ >= 0) nc_close(root_);
        root_ = -1;
        return test::text_of(file_.path());
    }

  private:
    OneFile file_;
    int root_ = -1, id_ = -1, frame_ = -1, atom_ = -1, spatial_ = -1;
};

TEST(Amber, AllKindsOfFilesAreRead) {
    for (const int kind : {0, NC_64BIT_OFFSET, NC_64BIT_DATA, NC_NETCDF4}) {
        Bed bed(kind, "meter", "second", kind == NC_NETCDF4);
        const std::string bytes = bed.bytes();
        ASSERT_TRUE(takes(amber_format(), bytes)) << kind;
        EXPECT_THAT(counts(amber_format(), bytes), ElementsAre(grains, grains)) << kind;
        const RawFrame frame = frame_of(amber_format(), bytes, 1);
        EXPECT_EQ(frame.time, 0.5);
        EXPECT_THAT(column(frame.grains, "y"), ElementsAre(place(1, 0, 1), place(1, 1, 1), place(1, 2, 1)));
        EXPECT_THAT(column(frame.grains, "radius"), ElementsAre(1, 2, 3));
        EXPECT_THAT(column(frame.grains, "id"), ElementsAre(7, 5, 3));
        EXPECT_DOUBLE_EQ(column(frame.grains, "velocities:2")[1], 2 * 20.455);
    }
}

TEST(Amber, ABoxHasLengthsAndAnglesAndMayBeOpen) {
    const RawFrame frame = frame_of(amber_format(), Bed(NC_64BIT_OFFSET).bytes());
    ASSERT_TRUE(frame.box.has_value());
    EXPECT_EQ(frame.box->origin, Vec3(-2, -1, 0));
    EXPECT_EQ(frame.box->edges[0], Vec3(4, 0, 0));
    EXPECT_TRUE(frame.box->edges[1].isApprox(Vec3(5 * 0.5, 5 * std::sqrt(0.75), 0)));  // 60 degrees to x
    EXPECT_EQ(frame.box->edges[2], Vec3(0, 0, 0));
    EXPECT_THAT(frame.box->periodic, ElementsAre(true, true, false));
}

TEST(Amber, UnitsAreTold) {
    const auto facts = [](const char* length, const char* time) {
        const OneFile file(Bed(NC_64BIT_OFFSET, length, time).bytes());
        return amber_format().open(file.path())->facts();
    };
    EXPECT_EQ(facts("m", "s").length_unit, 1);
    EXPECT_EQ(facts("nanometer", "microseconds").length_unit, 1e-9);
    EXPECT_EQ(facts("nanometer", "microseconds").time_unit, 1e-6);
    EXPECT_EQ(facts("angstrom", "picosecond").length_unit, 1e-10);
    EXPECT_EQ(facts("lj", "lj").units, "lj");
    EXPECT_NEAR(facts("Inches", "hour").length_unit.value(), 0.0254, 1e-15);
    EXPECT_EQ(facts("Inches", "hour").time_unit, 3600);
    EXPECT_FALSE(facts("sigma", "s").length_unit.has_value());
    EXPECT_FALSE(facts("s", "m").length_unit.has_value());  // no length, and no time
    EXPECT_FALSE(facts("s", "m").time_unit.has_value());
}

// The grains are of millimetres, but the file says angstrom because the convention asks for it.
TEST(Amber, AnAngstromThatCannotBeIsNotBelieved) {
    Bed bed(NC_64BIT_OFFSET, "angstrom", "picosecond");
    bed.put(bed.variable("coordinates"), {0, 0, 0}, {1, grains, 3}, {0, 0, 0, .1, .1, .1, .2, .2, .2});
    const OneFile file(bed.bytes());
    const std::unique_ptr<RawFile> opened = amber_format().open(file.path());
    EXPECT_FALSE(opened->facts().length_unit.has_value());
    EXPECT_FALSE(opened->facts().time_unit.has_value());
    EXPECT_THAT(opened->news(), ElementsAre(HasSubstr("says angstrom")));
}

TEST(Amber, FillValuesAtTheEndAreNoGrains) {
    Bed bed(NC_64BIT_OFFSET);
    const double fill = NC_FILL_DOUBLE;
    bed.put(bed.variable("coordinates"), {1, 2, 0}, {1, 1, 3}, {fill, fill, fill});
    const std::string bytes = bed.bytes();
    EXPECT_THAT(counts(amber_format(), bytes), ElementsAre(3, 2));
    EXPECT_THAT(column(frame_of(amber_format(), bytes, 1).grains, "radius"), ElementsAre(1, 2));
}

TEST(Amber, AGrainWithoutAPlaceIsRefused) {
    Bed bed(NC_64BIT_OFFSET);
    bed.put(bed.variable("coordinates"), {1, 1, 0}, {1, 1, 3}, {1, NAN, 2});
    EXPECT_THAT(complaint_of(amber_format(), bed.bytes()), tells({"frame 1", "grain 1", "no place"}));
}

TEST(Amber, ACutFileGivesItsWholeFrames) {
    const std::string bytes = Bed(NC_64BIT_OFFSET).bytes();
    const std::string cut = bytes.substr(0, bytes.size() - 8);
    EXPECT_THAT(counts(amber_format(), cut), ElementsAre(grains));
    EXPECT_THAT(news_of(amber_format(), cut), testing::AllOf(HasSubstr("last frame"), HasSubstr("left out")));
    const std::string packed = Bed(NC_NETCDF4).bytes();
    EXPECT_THAT(complaint_of(amber_format(), packed.substr(0, packed.size() - 1)), HasSubstr("is cut off"));
    EXPECT_THAT(complaint_of(amber_format(), packed.substr(0, 30)), HasSubstr("is cut off"));
}

// The header counts records (bytes 4 to 7, or 4 to 11 in CDF-5), and a program that was stopped may not have
// counted any.
TEST(Amber, AHeaderThatCountsNoFrameIsRefusedWithTheCount) {
    std::string bytes = Bed(NC_64BIT_OFFSET).bytes();
    bytes.replace(4, 4, 4, '\0');
    EXPECT_THAT(complaint_of(amber_format(), bytes),
                testing::AllOf(tells({"counts no frame", "room for 2"}),
                               HasSubstr("printf '\\000\\000\\000\\002' | dd of=")));
    bytes = Bed(NC_64BIT_DATA).bytes();
    bytes.replace(4, 8, 8, '\0');
    EXPECT_THAT(complaint_of(amber_format(), bytes), HasSubstr("'\\000\\000\\000\\000\\000\\000\\000\\002'"));
}

TEST(Amber, FramesThatTheHeaderDoesNotCountAreTold) {
    std::string bytes = Bed(NC_64BIT_OFFSET).bytes();
    bytes[7] = '\1';
    EXPECT_THAT(counts(amber_format(), bytes), ElementsAre(grains));
    EXPECT_THAT(news_of(amber_format(), bytes), tells({"counts 1 frame", "room for 2"}));
    const std::string whole = Bed(NC_64BIT_OFFSET).bytes();
    EXPECT_THAT(news_of(amber_format(), whole + std::string(10, 'x')),
                tells({"10 bytes", "behind its 2 frames"}));
    EXPECT_EQ(news_of(amber_format(), whole), "");
}

// The count is that of "streaming": the file has as many frames as there is room for.
TEST(Amber, AHeaderMayLeaveTheCountOpen) {
    std::string bytes = Bed(NC_64BIT_OFFSET).bytes();
    bytes.replace(4, 4, 4, '\xff');
    EXPECT_THAT(counts(amber_format(), bytes), ElementsAre(grains, grains));
}

TEST(TrialInChild, ACrashEndsTheChildAlone) {
    int changed = 0;
    EXPECT_NO_THROW(try_in_child("bed.h5", [&] { changed = 1; }));
    EXPECT_NO_THROW(try_in_child("bed.h5", [] { throw UserError("refused"); }));
    EXPECT_THROW(try_in_child("bed.h5", [] { std::abort(); }), UserError);
    EXPECT_EQ(changed, 0);
}

// Whatever value a byte of an HDF5 file gets, the file is read or refused.
TEST(Amber, AnyByteOfHdf5MayBeWrong) {
    const std::string bytes = Bed(NC_NETCDF4).bytes();
    for (std::size_t at = 8; at < bytes.size(); at += 331) {
        std::string wrong = bytes;
        wrong[at] = static_cast<char>(wrong[at] ^ 0x5a);
        complaint_of(amber_format(), wrong);
    }
}

TEST(Amber, NetcdfWithoutGrainsIsRefused) {
    const OneFile file("");
    std::filesystem::remove(file.path());
    int id = -1;
    nc_create(file.path().c_str(), NC_64BIT_OFFSET, &id);
    nc_close(id);
    EXPECT_THAT(complaint_of(amber_format(), test::text_of(file.path())), HasSubstr("no dimension atom"));
}

}  // namespace
}  // namespace grainreel
