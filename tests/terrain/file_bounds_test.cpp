// What a small file may make the program take: blocks are asked for in memory, ground in tiles is told before
// it takes room, and what lies beside a raster and is no file is not waited for.
#include "gdal_reading.h"
#include "terrain/read/dem_rows.h"
#include "terrain/read/raster_file.h"
#include "terrain/scene/tiled_ground.h"
#include "tests/support/watched_pipe.h"
#include "tiled_case.h"

namespace stereonav::test {
namespace {
namespace fs = std::filesystem;

void showAll(const fs::path& file) {
    glanceAtDem(file);
    readGround(file);
    DemRows rows(file, 64);
    std::vector<float> heights(static_cast<std::size_t>(rows.place().width) * rows.place().height);
    rows.read(0, rows.place().height, heights.data());
    rows.identity();
}

RasterSpec smallGround(GDALDataType type = GDT_Int16) {
    RasterSpec spec;
    spec.width = spec.height = 32;
    spec.type = type;
    spec.value = [](int c, int r, int) { return 100 + c + r; };
    return spec;
}

TEST(FileBounds, PipesBesideARasterAreNotWaitedFor) {
    const TempFolder folder;
    const fs::path tiff = writeRaster(folder / "ground.tif", smallGround());
    RasterSpec envi = smallGround();
    envi.driver = "ENVI";
    const fs::path plain = writeRaster(folder / "plain.img", envi);
    folder.text("grid.asc", "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 30\n1 2 3\n4 5 6\n");
    for (const char* name :
         {"ground.tif.aux.xml", "ground.aux",  "ground.tif.aux",   "ground.tif.ovr", "ground.tif.msk",
          "ground.tfw",         "ground.tifw", "ground.wld",       "ground.prj",     "ground.tab",
          "ground.IMD",         "ground.RPB",  "ground_rpc.txt",   "METADATA.DIM",   "ground.xml",
          "ground.tif.xml",     "grid.prj",    "grid.asc.aux.xml", "plain.sta",      "plain.img.aux.xml"}) {
        SCOPED_TRACE(name);
        WatchedPipe pipe(folder / name);
        for (const fs::path& file : {tiff, folder / "grid.asc", plain}) EXPECT_NO_THROW(showAll(file));
        EXPECT_FALSE(pipe.wasOpened());
    }
    fs::remove(folder / "plain.hdr");
    WatchedPipe header(folder / "plain.hdr");
    EXPECT_NE(errorOf([&] { readGround(plain); }), "");
    EXPECT_FALSE(header.wasOpened());
}

TEST(FileBounds, PipesBesideADatabaseAreNamed) {
    const TempFolder folder;
    RasterSpec spec = smallGround(GDT_Byte);
    spec.driver = "GPKG", spec.bands = 3;
    const fs::path file = writeRaster(folder / "map.gpkg", spec);
    for (const char* end : {"-journal", "-wal"}) {
        WatchedPipe pipe(folder / (std::string("map.gpkg") + end));
        EXPECT_THAT(errorOf([&] { openRasterPicture(file, "a picture", "give one"); }),
                    AllOf(HasSubstr(std::string("map.gpkg") + end), HasSubstr("found a pipe or a device"),
                          Not(HasSubstr("\n"))));
        EXPECT_FALSE(pipe.wasOpened());
    }
    EXPECT_NO_THROW(openRasterPicture(file, "a picture", "give one"));
}

class LargeBlocks : public TiledCase {
protected:
    // A few kilobytes that unpack to two bytes a sample.
    fs::path packed(const std::string& name, int side, const std::vector<const char*>& more = {}) {
        RasterSpec spec;
        spec.width = spec.height = side;
        spec.type = GDT_Int16;
        spec.value = [](int, int, int) { return 7; };
        spec.options = {"COMPRESS=DEFLATE", "ZLEVEL=1"};
        spec.options.insert(spec.options.end(), more.begin(), more.end());
        return writeRaster(mFolder / name, spec);
    }
};

TEST_F(LargeBlocks, AreAskedForBeforeTheyAreTaken) {
    const fs::path file = packed("one.tif", 4096, {"TILED=YES", "BLOCKXSIZE=4096", "BLOCKYSIZE=4096"});
    ASSERT_LT(fs::file_size(file), 1'000'000u);
    const fs::path named =
        mFolder.text("named.vrt",
                     "<VRTDataset rasterXSize=\"40\" rasterYSize=\"40\"><VRTRasterBand dataType=\"Int16\" "
                     "band=\"1\"><SimpleSource><SourceFilename relativeToVRT=\"1\">one.tif</SourceFilename>"
                     "<SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>");
    const fs::path beside = writeRaster(mFolder / "beside.tif", smallGround());
    fs::copy_file(file, mFolder / "beside.tif.msk");
    readGround(beside);  // what the library itself takes is there from now on
    limitMemory(bytesHeld() + 50e6);
    const auto refusal = AllOf(HasSubstr("one.tif:blocks: 4096 x 4096 samples at once need 67 MB of memory"),
                               HasSubstr("is available"), Not(HasSubstr("\n")));
    EXPECT_THAT(errorOf([&] { glanceAtDem(file); }), refusal);
    EXPECT_THAT(errorOf([&] { readGround(file); }), refusal);
    EXPECT_THAT(errorOf([&] { DemRows rows(file); }), refusal);
    EXPECT_THAT(errorOf([&] { openRasterPicture(file, "a picture", "give one"); }), refusal);
    EXPECT_THAT(errorOf([&] { readGround(named); }), HasSubstr("samples at once need 67 MB of memory"));
    const double before = bytesHeld();
    readGround(beside);
    EXPECT_LT(bytesHeld() - before, 30e6) << "its mask was unpacked";
    limitMemory(0);
    EXPECT_EQ(readGround(file).heights.front(), 7);
}

TEST_F(LargeBlocks, GroundOfFewBytesIsToldBeforeItTakesRoomOnDisk) {
    mFile.dem = mFile.file = packed("flat.tif", 2048);
    mFile.tiles = GroundTiles::On;
    const auto notesOf = [&] {
        std::vector<std::string> notes;
        Progress progress({}, [&](const std::string& note) { notes.push_back(note); });
        readGroundInTiles(mFile, progress);
        return notes;
    };
    const std::vector<std::string> first = notesOf();
    ASSERT_EQ(first.size(), 1u);
    EXPECT_THAT(first[0],
                AllOf(HasSubstr(mFile.dem.string() + ": holds 2048 x 2048 samples in "),
                      HasSubstr(" MB of disk in " + (mFolder / "cache").string()), Not(HasSubstr("\n"))));
    EXPECT_EQ(notesOf(), std::vector<std::string>()) << "they are there";
    RasterSpec spec = smallGround();
    spec.width = spec.height = 300;
    mFile.dem = mFile.file = writeRaster(mFolder / "small.tif", spec);
    EXPECT_EQ(notesOf(), std::vector<std::string>());
}

}  // namespace
}  // namespace stereonav::test
