// Editor for a volume's transfer function, over a histogram of its values, and for its isovalue.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/view/beside_work.h"
#include "app/view/scene_changes.h"
#include "app/view/transfer_curve.h"
#include "engine/scene/shown_values.h"

struct ImVec2;

namespace stereonav {

class TransferPanel {
public:
    // Returns whether the scene has a transfer function.
    static bool has(const Scene& scene);
    // grey: shows colours as grey, for glasses that separate colours.
    void draw(SceneChanges& changes, const ViewSession& session, bool grey);
    void forget();  // drops histograms, also one that is being counted

private:
    enum class Held { Nothing, Point, Isovalue };
    struct Plot;

    void count(const std::shared_ptr<const StudyValues>& values);
    void follow(const SceneChanges& changes, const ShownValues& shown);
    void change(SceneChanges& changes);
    void drawPlot(SceneChanges& changes, bool grey);
    void drawBars(const Plot& plot);
    void drawColors(const Plot& plot, bool grey);
    void drawCurve(const Plot& plot);
    void drawPoints(const Plot& plot, bool grey);
    void drawIsovalue(const Plot& plot);
    void usePointer(SceneChanges& changes, const Plot& plot);
    void drag(SceneChanges& changes, const Plot& plot, const ImVec2& pointer);
    void tell(const Plot& plot, const ImVec2& pointer);
    void drawPoint(SceneChanges& changes);
    void drawButtons(SceneChanges& changes, const BegunSurface& begun);
    std::size_t pointNear(const Plot& plot, const ImVec2& at) const;
    bool isovalueNear(const Plot& plot, const ImVec2& at) const;
    std::string withUnit(double value) const;

    std::shared_ptr<const StudyValues> mValues;
    std::optional<BesideWork<ValueCounts>> mCounting;
    std::optional<ValueCounts> mCounts;
    std::vector<float> mBars;
    ValueView mBarsOf;

    TransferCurve mCurve{TransferFunction()};
    std::string mText;  // text that was set from mCurve
    std::optional<double> mIsovalue;
    ValueView mAll, mView;
    bool mZoomed = false;
    Held mHeld = Held::Nothing;
    std::size_t mPoint = TransferCurve::kNone;  // point that is dragged, or whose colour is chosen
    double mFromValue = 0, mFromOpacity = 0;    // from the pointer to the dragged point
};

}  // namespace stereonav
