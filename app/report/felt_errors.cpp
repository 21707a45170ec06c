#include "app/report/felt_errors.h"

#include <algorithm>
#include <cmath>

#include "app/report/trial.h"
#include "engine/metrics/butteraugli.h"
#include "engine/metrics/flicker.h"
#include "engine/metrics/image_difference.h"

namespace stereonav {

void FeltErrors::Squares::add(double psnr_db) {
    if (std::isnan(psnr_db)) return;
    const double off = rmsOfPsnr(psnr_db);
    sum += off * off;
    ++frames;
}

double FeltErrors::rms(const Squares& squares) {
    return squares.frames > 0 ? std::sqrt(squares.sum / squares.frames) : 0;
}

Plane<float> FeltErrors::add(const FeltTruth& truth, const TwoEyes& eyes,
                             const Plane<PackedColor>& rightNext) {
    ++mFrames;
    mRight.add(psnrOf(truth.right, eyes.right));
    mLeft.add(psnrOf(truth.left, eyes.left));
    mFlicker.add(flickerPsnr({truth.right, truth.rightNext}, {eyes.right, rightNext}));
    const Rivalry rivalry = rivalryOf(truth.columns, {truth.left, truth.right}, eyes, truth.edges);
    mRivalry.add(rivalry.psnr_db);
    mEdgeRivalry.add(rivalry.edge_psnr_db);
    ButteraugliMap map = butteraugliOf(truth.right, eyes.right);
    mButteraugli += map.norm3;
    mMost = std::max(mMost, map.max);
    const ButteraugliParts parts = partsOf(map.distances, truth.edges);
    if (!std::isnan(parts.inside)) mEdges += parts.inside, ++mWithEdges;
    if (!std::isnan(parts.outside)) mFlat += parts.outside, ++mWithFlat;
    return std::move(map.distances);
}

void FeltErrors::add(const FeltErrors& others) {
    mFrames += others.mFrames;
    for (const auto squares : {&FeltErrors::mFlicker, &FeltErrors::mRivalry, &FeltErrors::mEdgeRivalry,
                               &FeltErrors::mRight, &FeltErrors::mLeft})
        (this->*squares).add(others.*squares);
    mButteraugli += others.mButteraugli;
    mMost = std::max(mMost, others.mMost);
    mEdges += others.mEdges;
    mWithEdges += others.mWithEdges;
    mFlat += others.mFlat;
    mWithFlat += others.mWithFlat;
}

std::vector<std::pair<std::string, double>> FeltErrors::others() const {
    return {{"RMS against the truth", rms(mRight)},
            {"left eye's", rms(mLeft)},
            {"rivalry", rivalry()},
            {"rivalry at edges", rms(mEdgeRivalry)},
            {"Butteraugli", butteraugli()},
            {"its largest", mMost},
            {"at edges", mEdges / std::max(1, mWithEdges)},
            {"elsewhere", mFlat / std::max(1, mWithFlat)}};
}

void addFeltCharts(ReportRun& run, ReportSection& section, const std::string& scene, const WayChart& frame,
                   const std::vector<WayPoint>& points, const std::vector<FeltErrors>& errors) {
    struct Measure {
        const char *id, *title, *label, *unit;
        double (FeltErrors::*value)() const;
    };
    constexpr Measure kMeasures[] = {
        {"flicker", "Flicker", "RMS flicker, 8-bit levels", "levels", &FeltErrors::flicker},
        {"rivalry", "Rivalry of the eyes", "RMS rivalry, 8-bit levels", "levels", &FeltErrors::rivalry},
        {"butteraugli", "Butteraugli", "Butteraugli, 3-norm", "", &FeltErrors::butteraugli}};
    for (const Measure& measure : kMeasures) {
        WayChart chart = frame;
        chart.id = std::string(measure.id) + "/" + scene;
        chart.title = std::string(measure.title) + ", " + frame.title;
        chart.errorLabel = measure.label;
        chart.errorUnit = measure.unit;
        for (std::size_t n = 0; n < points.size(); ++n) {
            WayPoint point = points[n];
            point.way.error = point.worstError = (errors[n].*measure.value)();
            point.others = measure.value == &FeltErrors::flicker
                               ? errors[n].others()
                               : std::vector<std::pair<std::string, double>>{};
            chart.points.push_back(std::move(point));
        }
        addChart(run.report(), section, std::move(chart));
    }
}

}  // namespace stereonav
