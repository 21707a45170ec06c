// Elevation models read in runs of rows, for ground larger than memory; readDem() reads all at once. The
// reader itself is in GDAL's module (terrain/read/gdal/dem_rows_reader.cpp).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "terrain/read/dem_reader.h"

namespace stereonav {

// Replaces each NaN of a grid by a value that fits the numbers around it (terrain/ground/nodata.h).
using FillBetween = std::function<void(std::vector<float>& values, int width, int height)>;

// The rows of one elevation model, for one thread at a time. At most 2^20 samples a side and 2^40 in all.
//
// Heights are those of readDem(), bit for bit, where its samples stay as they are. Ground that has to be
// resampled (degrees, feet, rotated, control points, web Mercator) is resampled in the same way, except that
// summits and pits between two samples of the grid are not restored, since that takes all samples at once. So
// where a height differs from readDem()'s, that has a summit or pit of the file, and this has a value
// interpolated between the samples around it.
class DemRows {
public:
    // Interface of the module's reader; its functions are those below.
    class Reader {
    public:
        virtual ~Reader() = default;
        virtual const DemGrid& place() const = 0;
        virtual int runOfRows() const = 0;
        virtual int firstRun() const = 0;
        virtual void read(int first, int rows, float* heights) = 0;
        virtual bool mustBeReadAgain() = 0;
        virtual void checkHeights(double verticalScale) const = 0;
        virtual std::uint64_t identity() const = 0;
        virtual double bytesOfFiles() const = 0;
        virtual double bytesOfBlock() const = 0;
        virtual bool isPacked() const = 0;
        virtual bool readSpread(double time_ms, double most_ms, const FillBetween& fill) = 0;
    };

    // Opens the file without reading samples, except for the single tile of a GSI elevation tile. Throws
    // Error as readDem() does for files that can not be read.
    explicit DemRows(const std::filesystem::path& file);
    // Opens the file thinned to at most `most` samples, >= 4, spread over all of the ground, from the file's
    // overviews where it has them. A text file gives all of its samples.
    DemRows(const std::filesystem::path& file, long long most);

    // Returns the grid as readDem() does, without the heights and without counts of samples (sourceMissing
    // and outside are 0).
    const DemGrid& place() const { return mReader->place(); }

    // Returns the number of rows to read at once for best speed: whole blocks of the file, at most 256.
    int runOfRows() const { return mReader->runOfRows(); }
    // Returns the number of rows of the southernmost run, after which runs begin where blocks of the file
    // begin, at most runOfRows(). A caller that reads firstRun() rows, then runOfRows() at a time, decodes no
    // block twice.
    int firstRun() const { return mReader->firstRun(); }

    // Reads rows first .. first + rows - 1, counted from the south, with place().width heights each in metres
    // (without vertical scale); NaN where missing. Throws Error ("row ... of ...: the file is cut off or
    // damaged"), Cancelled.
    void read(int first, int rows, float* heights) { mReader->read(first, rows, heights); }

    // Returns true where the file names no nodata value and all samples show that -9999 stands for missing
    // ones: it is far below all other heights. To be called after all rows were read. A caller that keeps
    // heights must then read all rows again, in which those samples are missing. True only once.
    bool mustBeReadAgain() { return mReader->mustBeReadAgain(); }

    // Throws Error, once all rows were read, where heights can not be held in single precision, all samples
    // are missing, or heights times the vertical scale are out of range, in the words of readDem(). For
    // ground that is resampled, only source samples around those of the grid count.
    void checkHeights(double verticalScale) const { mReader->checkHeights(verticalScale); }

    // Returns whether samples lie in compressed blocks that span many rows, without overviews: reading a few
    // samples is then slow.
    bool isPacked() const { return mReader->isPacked(); }

    // Decodes blocks of the file spread evenly over it, as many as fit into time_ms, for callers that need
    // few samples. From then on read() gives the decoded samples, and between them what `fill` interpolates;
    // missing where most of the decoded samples nearby are. Returns false, having changed nothing, where
    // blocks are too large, where the smallest permitted number of them would take longer than most_ms, where
    // all samples are read anyway, or where the format can only be decoded from its beginning. Throws as
    // read() does.
    bool readSpread(double time_ms, double most_ms, const FillBetween& fill) {
        return mReader->readSpread(time_ms, most_ms, fill);
    }

    // Returns an identifier of the content, from path, size and time of change of each file that it is made
    // of, including overviews and the sources of virtual rasters.
    std::uint64_t identity() const { return mReader->identity(); }
    // Returns the bytes of all these files on disk.
    double bytesOfFiles() const { return mReader->bytesOfFiles(); }

    // Returns the bytes of memory that a block takes while it is read.
    double bytesOfBlock() const { return mReader->bytesOfBlock(); }

private:
    std::unique_ptr<Reader> mReader;
};

// Returns a reader from the module. most: samples at most; 0: all.
std::unique_ptr<DemRows::Reader> openDemRows(const std::filesystem::path& file, long long most);

}  // namespace stereonav
