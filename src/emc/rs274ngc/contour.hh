/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * contour.hh - the contour of a lathe cycle as lines and arcs in a plane.
 *
 * Points are complex numbers Z + iX (X radius), or a turned and mirrored image of it
 * in which the contour runs toward -Re and the stock lies on its +Im side.
 * Units:  program units
 * Source: G7x sheet
 */
#ifndef KERF_CONTOUR_HH
#define KERF_CONTOUR_HH

#include <complex>
#include <string>
#include <vector>

namespace ngc
{

using Plane = std::complex<double>;

struct Element {
    enum Kind : unsigned char { LINE, CW, CCW, FILLET, CHAMFER } kind;
    Plane start, end, centre;
    double size = 0; // of a fillet or chamfer

    bool is_arc() const { return kind == CW || kind == CCW; }
    bool is_corner() const { return kind == FILLET || kind == CHAMFER; }
    double length() const { return std::abs(end - start); }
    double radius() const { return std::abs(end - centre); }
};

/// Turns and mirrors between the machine's plane and the contour's.
struct Image {
    bool turned = false, mirror_im = false, mirror_re = false;
    Plane to(Plane p) const;   // machine -> image
    Plane from(Plane p) const; // image -> machine
    bool flips_arcs() const { return mirror_im != mirror_re; }
};

class Contour
{
  public:
    std::vector<Element> elements; // [0] is the lead-in, by which the tool comes
    Image image;

    /// Brings the contour to its normal position. False: `error` says why.
    bool normalise(bool turned);
    bool is_monotonic() const;
    /// Offsets to the stock side by delta; the lead-in's start stays.
    bool offset(double delta);
    void displace(Plane by);
    std::string error;

  private:
    bool finish_corners();
    bool offset_step(double step);
    bool join(size_t k);
    double smallest() const;
};

enum class Crossing { FIRST, LAST };
/// Where an element meets the level Im = x, in the direction of travel. False: it does not.
bool meets_level(const Element &e, double x, Crossing which, Plane *point);

} // namespace ngc

#endif
