// A file in a folder does not show what lies elsewhere on the machine: bytes of any file are read by no
// virtual raster from outside its folder, and rasters from outside are told.
#include <hdf5.h>

#include <cstdint>

#include "gdal_reading.h"
#include "terrain/read/dem_rows.h"
#include "terrain/read/raster_file.h"

namespace stereonav::test {
namespace {
namespace fs = std::filesystem;

constexpr int kNumbersSide = 16;
constexpr int kSecretHeight = 0x2122;  // number in bytes that are no heights

class OutsideFiles : public testing::Test {
protected:
    OutsideFiles() {
        for (const char* name : {"here", "here/below", "away"}) fs::create_directory(mFolder / name);
        for (const char* name : {"away/secret", "here/numbers", "here/below/numbers"})
            mFolder.text(name, numbers());
        RasterSpec spec;
        spec.width = spec.height = kNumbersSide;
        spec.value = [](int c, int r, int) { return 100 + c + r; };
        writeRaster(mFolder / "away/tile.tif", spec);
        writeRaster(mFolder / "here/ground.tif", spec);
    }

    static std::string numbers() {
        std::string bytes;
        for (int n = 0; n < kNumbersSide * kNumbersSide; ++n) bytes += "\x22\x21";
        return bytes;
    }
    static std::string virtualRaster(const std::string& bandMore, const std::string& inner) {
        return "<VRTDataset rasterXSize=\"16\" rasterYSize=\"16\"><GeoTransform>500000,30,0,4000240,0,-30"
               "</GeoTransform><VRTRasterBand dataType=\"Int16\" band=\"1\" " +
               bandMore + ">" + inner + "</VRTRasterBand></VRTDataset>";
    }
    // A band of plain numbers.
    static std::string raw(const std::string& name, const std::string& flag = "relativeToVRT=\"1\"",
                           const std::string& as = "subClass=\"VRTRawRasterBand\"") {
        return virtualRaster(as,
                             "<SourceFilename " + flag + ">" + name +
                                 "</SourceFilename><ImageOffset>0</ImageOffset><PixelOffset>2</PixelOffset>"
                                 "<LineOffset>32</LineOffset><ByteOrder>LSB</ByteOrder>");
    }
    static std::string source(const std::string& name, const std::string& more = "") {
        return virtualRaster("", "<SimpleSource><SourceFilename relativeToVRT=\"1\">" + name +
                                     "</SourceFilename>" + more +
                                     "<SourceBand>1</SourceBand></SimpleSource>");
    }
    fs::path here(const std::string& name, const std::string& text) const {
        return mFolder.text("here/" + name, text);
    }
    fs::path away(const std::string& name) const { return mFolder / ("away/" + name); }

    void expectOutside(const std::string& text) {
        SCOPED_TRACE(text);
        const fs::path file = here("raw.vrt", text);
        const auto refusal = AllOf(HasSubstr(file.string() + ": reads \""), HasSubstr("outside its folder"),
                                   HasSubstr("put that file beside it"), Not(HasSubstr("\n")));
        EXPECT_THAT(errorOf([&] { readGround(file); }), refusal);
        EXPECT_THAT(errorOf([&] { glanceAtDem(file); }), refusal);
        EXPECT_THAT(errorOf([&] { openRasterPicture(file, "a picture", "give one"); }), refusal);
    }

    TempFolder mFolder;
};

TEST_F(OutsideFiles, PlainNumbersOfItsFolderAreRead) {
    for (const std::string& text :
         {raw("numbers"), raw("below/numbers"), raw("./below/../numbers"), raw("numbers", ""),
          raw((mFolder / "here/numbers").string(), "relativeToVRT=\"0\"")}) {
        SCOPED_TRACE(text);
        EXPECT_EQ(readGround(here("raw.vrt", text)).heights.front(), kSecretHeight);
    }
}

TEST_F(OutsideFiles, PlainNumbersOfOtherFoldersAreRefused) {
    fs::create_symlink(away("secret"), mFolder / "here/link");
    const std::string whole = away("secret").string();
    for (const std::string& text :
         {raw(whole), raw(whole, ""), raw(whole, "relativeToVRT=\"0\""), raw("../away/secret"),
          raw("below/../../away/secret"), raw("link"), raw(whole, "", "subClass=\"vrtrawrasterband\""),
          raw(whole, "", "SUBCLASS=\"VRTRawRasterBand\""),
          virtualRaster(
              "", "<subClass>VRTRawRasterBand</subClass><SourceFilename>" + whole + "</SourceFilename>"),
          virtualRaster("subClass=\"VRTRawRasterBand\" SourceFilename=\"" + whole + "\"", ""),
          "<!--" + std::string(900, ' ') + "-->" + raw(whole)})
        expectOutside(text);
    here("inner.vrt", raw(whole));
    EXPECT_THAT(errorOf([&] { readGround(here("outer.vrt", source("inner.vrt"))); }),
                AllOf(HasSubstr("outer.vrt: "), HasSubstr("outside its folder")));
}

// A virtual raster where none is looked for: coarser samples, a mask, an archive, a name.
TEST_F(OutsideFiles, PlainNumbersAreNotReadByWayOfOtherFiles) {
    const fs::path ground = mFolder / "here/ground.tif";
    const std::string half =
        "<VRTDataset rasterXSize=\"8\" rasterYSize=\"8\"><VRTRasterBand dataType=\"Float32\" band=\"1\" "
        "subClass=\"VRTRawRasterBand\"><SourceFilename>" +
        away("secret").string() + "</SourceFilename></VRTRasterBand></VRTDataset>";
    std::string escaped = half;
    for (std::size_t at = 0; (at = escaped.find('<', at)) != std::string::npos;)
        escaped.replace(at, 1, "&lt;");
    const auto metadata = [](const std::string& name) {
        return "<PAMDataset><Metadata domain=\"OVERVIEWS\"><MDI key=\"OVERVIEW_FILE\">" + name +
               "</MDI></Metadata></PAMDataset>";
    };
    here("half.vrt", half);
    for (const auto& [end, text] : {std::pair<std::string, std::string>{".ovr", half},
                                    {".msk", half},
                                    {".aux.xml", metadata(escaped)},
                                    {".aux.xml", metadata(":::BASE:::half.vrt")},
                                    {".aux.xml", metadata((mFolder / "here/half.vrt").string())}}) {
        SCOPED_TRACE(end + ": " + text);
        const fs::path beside = here("ground.tif" + end, text);
        DemRows rows(ground, 64);
        const DemGrid& place = rows.place();
        std::vector<float> heights(static_cast<std::size_t>(place.width) * place.height);
        rows.read(0, place.height, heights.data());
        for (const float height : heights) {
            EXPECT_GE(height, 100);
            EXPECT_LE(height, 130);
        }
        fs::remove(beside);
    }
    const fs::path packed = here("heights.hgt.gz", raw(away("secret").string()));
    EXPECT_NE(errorOf([&] { readGround(packed); }), "");
}

// netCDF of the newer kind: numbers in a file beside it or elsewhere, links into other files.
TEST_F(OutsideFiles, NetCdfIsOneFile) {
    // The library ends by a signal over what a damaged file left open; the program asks for the same.
    H5dont_atexit();
    const hsize_t sides[2] = {kNumbersSide, kNumbersSide};
    const auto written = [&](const std::string& name, const std::function<void(hid_t, hid_t)>& adorn) {
        const fs::path file = mFolder / ("here/" + name);
        const hid_t open = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
        const hid_t space = H5Screate_simple(2, sides, nullptr);
        adorn(open, space);
        H5Sclose(space);
        H5Fclose(open);
        return file;
    };
    const auto add = [](hid_t to, const char* name, hid_t space, hid_t made) {
        const std::vector<std::int16_t> heights(kNumbersSide * kNumbersSide, 77);
        const hid_t data = H5Dcreate2(to, name, H5T_NATIVE_INT16, space, H5P_DEFAULT, made, H5P_DEFAULT);
        if (made == H5P_DEFAULT)
            H5Dwrite(data, H5T_NATIVE_INT16, H5S_ALL, H5S_ALL, H5P_DEFAULT, heights.data());
        H5Dclose(data);
    };
    const fs::path own =
        written("own.nc", [&](hid_t file, hid_t space) { add(file, "elevation", space, H5P_DEFAULT); });
    EXPECT_NO_THROW(readGround(own));
    const auto outside = [&](const std::string& place) {
        return written("outside.nc", [&](hid_t file, hid_t space) {
            const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
            H5Pset_external(made, place.c_str(), 0, 2 * kNumbersSide * kNumbersSide);
            add(file, "elevation", space, made);
            H5Pclose(made);
        });
    };
    const auto refusal =
        AllOf(HasSubstr("here/outside.nc:elevation: leads to another file"), Not(HasSubstr("\n")));
    for (const std::string& place : {away("secret").string(), std::string("numbers")})
        EXPECT_THAT(errorOf([&] { readGround(outside(place)); }), refusal);
    const fs::path linked = written("outside.nc", [&](hid_t file, hid_t) {
        H5Lcreate_external(own.c_str(), "/elevation", file, "elevation", H5P_DEFAULT, H5P_DEFAULT);
    });
    EXPECT_THAT(errorOf([&] { readGround(linked); }), refusal);
    const fs::path laid = written("outside.nc", [&](hid_t file, hid_t space) {
        const hid_t made = H5Pcreate(H5P_DATASET_CREATE);
        H5Pset_virtual(made, space, own.c_str(), "/elevation", space);
        add(file, "elevation", space, made);
        H5Pclose(made);
    });
    EXPECT_THAT(errorOf([&] { readGround(laid); }), refusal);
    // The name of the other file lies beyond the heap that holds names.
    std::fstream damaged(outside("x"), std::ios::in | std::ios::out | std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(damaged)), {});
    const std::size_t list = bytes.find(std::string("\x01\0\0\0\x01\0\x01\0", 8));
    ASSERT_NE(list, std::string::npos) << "no list of one other file";
    damaged.clear();
    damaged.seekp(static_cast<std::streamoff>(list) + 23);
    damaged.put('\x08');
    damaged.close();
    EXPECT_THAT(errorOf([&] { readGround(mFolder / "here/outside.nc"); }),
                AllOf(HasSubstr("outside.nc: the file is cut off or damaged"), Not(HasSubstr("\n"))));
    // A variable that metadata name for coarser samples.
    outside(away("secret").string());
    here("ground.tif.aux.xml",
         "<PAMDataset><Metadata domain=\"OVERVIEWS\"><MDI key=\"OVERVIEW_FILE\">NETCDF:\"" +
             (mFolder / "here/outside.nc").string() + "\":elevation</MDI></Metadata></PAMDataset>");
    EXPECT_EQ(readGround(mFolder / "here/ground.tif").heights.front(), 115);
}

TEST_F(OutsideFiles, OptionsThatMoveTheFolderAreRefused) {
    here("inner.vrt", raw("secret"));
    mFolder.text("away/tile", "");
    const std::string moved = source("inner.vrt", "<OpenOptions><OOI key=\"ROOT_PATH\">" +
                                                      (mFolder / "away").string() + "</OOI></OpenOptions>");
    EXPECT_NE(errorOf([&] { readGround(here("outer.vrt", moved)); }), "");
    here("secret", numbers());
    EXPECT_THAT(errorOf([&] { readGround(here("outer.vrt", moved)); }),
                AllOf(HasSubstr("outer.vrt"), HasSubstr("ROOT_PATH"), Not(HasSubstr("\n"))));
}

// Tiles in another folder, named as gdalbuildvrt does: rasters in their own right.
TEST_F(OutsideFiles, RastersOfOtherFoldersAreReadAndTold) {
    const std::string whole = away("tile.tif").string();
    for (const std::string& text : {source("../away/tile.tif"), source(whole)}) {
        SCOPED_TRACE(text);
        const fs::path file = here("tiles.vrt", text);
        const DemGrid dem = readGround(file);
        EXPECT_EQ(dem.heights.front(), 115);
        ASSERT_EQ(dem.notes.size(), 1u);
        EXPECT_THAT(dem.notes[0], AllOf(HasSubstr(file.string() + ": reads "), HasSubstr("away/tile.tif"),
                                        HasSubstr("outside its folder")));
    }
    const DemGrid own = readGround(here("own.vrt", source("ground.tif")));
    EXPECT_EQ(own.notes, std::vector<std::string>());
    const std::string twice = virtualRaster("", [&] {
        std::string both;
        for (const char* name : {"../away/tile.tif", "../away/tile.tif", "ground.tif"})
            both += "<SimpleSource><SourceFilename relativeToVRT=\"1\">" + std::string(name) +
                    "</SourceFilename><SourceBand>1</SourceBand></SimpleSource>";
        return both;
    }());
    EXPECT_THAT(readGround(here("twice.vrt", twice)).notes[0], HasSubstr(" and 1 more, outside its folder"));
}

TEST_F(OutsideFiles, OverviewsOfOtherFoldersAreRefused) {
    const auto metadata = [&](const std::string& name) {
        here("ground.tif.aux.xml", "<PAMDataset><Metadata domain=\"OVERVIEWS\"><MDI key=\"OVERVIEW_FILE\">" +
                                       name + "</MDI></Metadata></PAMDataset>");
        return errorOf([&] { readGround(mFolder / "here/ground.tif"); });
    };
    for (const std::string& name : {away("tile.tif").string(), std::string(":::BASE:::../away/tile.tif")})
        EXPECT_THAT(metadata(name), AllOf(HasSubstr("ground.tif:OVERVIEW_FILE: names "),
                                          HasSubstr("outside its folder"), Not(HasSubstr("\n"))));
    EXPECT_EQ(metadata(":::BASE:::ground.tif"), "");
    EXPECT_EQ(metadata(":::BASE:::none.tif"), "");
}

}  // namespace
}  // namespace stereonav::test
