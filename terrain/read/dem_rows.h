// Elevation models read a run of rows at a time, for ground larger than memory: what readDem() reads at once.
// The reader itself is in GDAL's module (terrain/read/gdal/dem_rows_reader.cpp).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "terrain/read/dem_reader.h"

namespace stereonav {

// Replaces each NaN of a grid by what fits the numbers around (terrain/ground/nodata.h).
using FillBetween = std::function<void(std::vector<float>& values, int width, int height)>;

// The rows of one elevation model, for one thread at a time. At most 2^20 samples a side and 2^40 in all.
//
// Heights are those of readDem(), bit for bit, where its samples stay as they are. Ground that has to be
// resampled (degrees, feet, turned, control points, web Mercator) is resampled alike, but summits and pits
// that lie between two samples of the grid are not put back: that takes all samples at once. A height that
// differs from readDem()'s is there one of the file's own summits or pits, and here what lies between the
// samples around it.
class DemRows {
public:
    // What the module gives; its functions are those below.
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

    // Opens it and reads no sample, but for the one tile of a GSI elevation tile. Throws Error as readDem()
    // does for what can not be read.
    explicit DemRows(const std::filesystem::path& file);
    // Opens it at `most` samples at most, >= 4, spread over all of the ground, of the file's overviews where
    // it has them. A text file gives all of its samples.
    DemRows(const std::filesystem::path& file, long long most);

    // Returns the grid of readDem(), but for the heights and what is counted over samples (sourceMissing,
    // outside: 0).
    const DemGrid& place() const { return mReader->place(); }

    // Rows that are best read at once: whole blocks of the file, at most 256.
    int runOfRows() const { return mReader->runOfRows(); }
    // Rows of the southernmost run, at most as many, from which on runs begin where blocks of the file begin:
    // who reads firstRun(), then runOfRows() at a time, decodes no block twice.
    int firstRun() const { return mReader->firstRun(); }

    // Rows first .. first + rows - 1 counted from the south, of place().width heights each in metres (no
    // vertical scale); NaN where missing. Throws Error ("row ... of ...: the file is cut off or damaged"),
    // Cancelled.
    void read(int first, int rows, float* heights) { mReader->read(first, rows, heights); }

    // Returns true where -9999 alone, far below all else, in a file that names no nodata value, stands for
    // missing samples. Only all samples tell, so it is asked after all rows were read. Whoever keeps the
    // heights then reads all rows again, in which they are missing. True once: afterwards they are missing in
    // whatever is read.
    bool mustBeReadAgain() { return mReader->mustBeReadAgain(); }

    // Throws Error, once all rows were read, where heights are not what single precision holds, or all
    // samples are missing, or heights times the vertical scale leave their range, as readDem() says it. Of
    // ground that is resampled only samples around those of the grid count.
    void checkHeights(double verticalScale) const { mReader->checkHeights(verticalScale); }

    // Returns whether samples lie in compressed blocks, of which each row takes many, and there are no
    // overviews: bad for who reads a few samples.
    bool isPacked() const { return mReader->isPacked(); }

    // Decodes blocks of the file spread evenly over it, as many as time_ms gives, for who reads a few
    // samples; from then on read() gives what they hold and what `fill` puts between them. It is missing
    // where most of what was read nearby is. Returns false where blocks are too large or too slow for the
    // fewest of them (most_ms), all samples are read, or the format is decoded from its beginning: then
    // nothing is changed. Throws as read() does.
    bool readSpread(double time_ms, double most_ms, const FillBetween& fill) {
        return mReader->readSpread(time_ms, most_ms, fill);
    }

    // Identifies the content by path, size and time of change of each file that it is made of, overviews and
    // the sources of virtual rasters among them.
    std::uint64_t identity() const { return mReader->identity(); }
    // Bytes of all these files on disk.
    double bytesOfFiles() const { return mReader->bytesOfFiles(); }

    // Bytes of memory that a block takes while it is read.
    double bytesOfBlock() const { return mReader->bytesOfBlock(); }

private:
    std::unique_ptr<Reader> mReader;
};

// Returns a reader from the module. most: samples at most; 0: all.
std::unique_ptr<DemRows::Reader> openDemRows(const std::filesystem::path& file, long long most);

}  // namespace stereonav
