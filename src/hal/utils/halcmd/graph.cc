/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * graph.cc - the net list as a picture (SVG): a box for each group of pins with a common
 * beginning of their names (and2.0), inputs at its left, outputs at its right, a line for
 * each signal with its present value.
 *
 * Method: layers from left to right along the signals (links that close a loop are left out
 * of the layering), within a layer ordered by the mean place of the neighbours, as in
 * Sugiyama, Tagawa and Toda 1981. Lengths are in SVG user units (pixels).
 */
#include "commands.hh"
#include "format.hh"
#include "snapshot.hh"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>

namespace halcmd
{

namespace
{

constexpr double LETTER = 6.7;     ///< width of a letter of 11 px monospace
constexpr double ROW = 16;         ///< height of a pin's row
constexpr double HEAD = 22;        ///< height of a box's title
constexpr double GAP_Y = 26, MARGIN = 24;
constexpr double MIN_GAP_X = 90;   ///< between columns, at least
constexpr int SWEEPS = 8;          ///< of the ordering within layers

std::string escaped(const std::string &text)
{
    std::string t;
    for (char c : text) {
        switch (c) {
        case '<': t += "&lt;"; break;
        case '>': t += "&gt;"; break;
        case '&': t += "&amp;"; break;
        case '"': t += "&quot;"; break;
        default: t += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
        }
    }
    return t;
}

const char *color_of(hal_type_t type, const hal_query_value_u &v)
{
    switch (type) {
    case HAL_BIT: return v.b ? "#2e9e3f" : "#7a9e80";
    case HAL_FLOAT: return "#2563a8";
    case HAL_PORT: return "#7b3fa0";
    default: return "#b8701c";
    }
}

struct Box {
    std::string name, comp;
    std::vector<const Item *> left, right; ///< IN; OUT and I/O
    bool bend = false; ///< no box: a place in a layer that a long line passes
    int layer = 0;
    double place = 0; ///< within its layer, while ordering
    double x = 0, y = 0, width = 0, height = 0;
};

struct Wire {
    const SignalItem *signal;
    const Item *from, *to; ///< either may be null: the signal ends free
    std::vector<size_t> bends; ///< boxes that are no boxes, from left to right
};

class Picture
{
  public:
    Picture(const Patterns &wanted) : pins(list_pins()), signals(list_signals())
    {
        auto of = pins_by_signal(pins);
        for (auto &s : signals)
            if (matches(wanted, s.name.c_str())) add_signal(s, of[s.name]);
        layer();
        bend();
        order();
        place();
    }

    std::string svg() const
    {
        std::string t = strf("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
                             "viewBox=\"0 0 %.0f %.0f\" font-family=\"monospace\" font-size=\"11\">\n"
                             "<rect width=\"100%%\" height=\"100%%\" fill=\"#fcfcfa\"/>\n",
                             width, height, width, height);
        const SignalItem *labelled = nullptr; // wires of a signal stand together
        for (auto &w : wires) {
            t += wire(w, !w.from || w.signal != labelled);
            labelled = w.signal;
        }
        for (auto &b : boxes)
            if (!b.bend) t += box(b);
        return t + "</svg>\n";
    }

  private:
    std::vector<Item> pins;
    std::vector<SignalItem> signals;
    std::vector<Box> boxes;
    std::map<std::string, size_t> box_of_name;
    std::map<const Item *, size_t> box_of_pin;
    std::vector<Wire> wires;
    std::vector<std::vector<size_t>> layers;
    std::map<const Wire *, double> lane; ///< y of lines that run back
    double width = 0, height = 0;

    void add_pin(const Item *pin)
    {
        size_t dot = pin->name.rfind('.');
        std::string name = dot == std::string::npos ? pin->comp : pin->name.substr(0, dot);
        auto [found, fresh] = box_of_name.try_emplace(name, boxes.size());
        if (fresh) {
            boxes.emplace_back();
            boxes.back().name = name;
            boxes.back().comp = pin->comp;
        }
        Box &b = boxes[found->second];
        (pin->dir == HAL_IN ? b.left : b.right).push_back(pin);
        box_of_pin[pin] = found->second;
    }

    void add_signal(const SignalItem &s, const std::vector<const Item *> &linked)
    {
        if (linked.empty()) return;
        const Item *from = nullptr;
        for (auto *p : linked) {
            add_pin(p);
            if (p->dir == HAL_OUT || (p->dir == HAL_IO && !from)) from = p;
        }
        bool read = false;
        for (auto *p : linked)
            if (p != from) {
                wires.push_back({&s, from, p, {}});
                read = true;
            }
        if (!read) wires.push_back({&s, from, nullptr, {}});
    }

    /// Longest path from boxes without a predecessor; links found to close a loop do not count.
    void layer()
    {
        std::vector<std::vector<size_t>> next(boxes.size());
        for (auto &w : wires)
            if (w.from && w.to) next[box_of_pin.at(w.from)].push_back(box_of_pin.at(w.to));
        enum { NEW, OPEN, DONE };
        std::vector<int> state(boxes.size(), NEW);
        std::vector<size_t> finished;
        struct Visit {
            size_t box, edge;
        };
        std::vector<std::vector<size_t>> forward(boxes.size());
        // Boxes with more outgoing than incoming lines come first: fewer lines run back.
        std::vector<long> surplus(boxes.size(), 0);
        for (size_t i = 0; i < boxes.size(); i++)
            for (size_t to : next[i]) {
                surplus[i]++;
                surplus[to]--;
            }
        std::vector<size_t> roots(boxes.size());
        for (size_t i = 0; i < roots.size(); i++) roots[i] = i;
        std::stable_sort(roots.begin(), roots.end(), [&](size_t a, size_t b) { return surplus[a] > surplus[b]; });
        for (size_t root : roots) {
            if (state[root] != NEW) continue;
            std::vector<Visit> path = {{root, 0}};
            state[root] = OPEN;
            while (!path.empty()) {
                auto &[at, edge] = path.back();
                if (edge == next[at].size()) {
                    state[at] = DONE;
                    finished.push_back(at);
                    path.pop_back();
                    continue;
                }
                size_t to = next[at][edge++];
                if (state[to] == OPEN) continue;
                forward[at].push_back(to);
                if (state[to] == NEW) {
                    state[to] = OPEN;
                    path.push_back({to, 0});
                }
            }
        }
        for (auto i = finished.rbegin(); i != finished.rend(); ++i)
            for (size_t to : forward[*i]) boxes[to].layer = std::max(boxes[to].layer, boxes[*i].layer + 1);
        for (size_t i = 0; i < boxes.size(); i++) {
            size_t l = boxes[i].layer;
            if (layers.size() <= l) layers.resize(l + 1);
            layers[l].push_back(i);
        }
    }

    /// Lines that pass a layer get a place of their own in it.
    void bend()
    {
        for (auto &w : wires) {
            if (!w.from || !w.to) continue;
            const int last = boxes[box_of_pin.at(w.to)].layer;
            for (int l = boxes[box_of_pin.at(w.from)].layer + 1; l < last; l++) {
                w.bends.push_back(boxes.size());
                layers[l].push_back(boxes.size());
                boxes.emplace_back();
                boxes.back().bend = true;
                boxes.back().layer = l;
            }
        }
    }

    void order()
    {
        std::vector<std::vector<size_t>> neighbours(boxes.size());
        for (auto &w : wires) {
            if (!w.from || !w.to) continue;
            size_t at = box_of_pin.at(w.from);
            auto link = [&](size_t to) {
                neighbours[at].push_back(to);
                neighbours[to].push_back(at);
                at = to;
            };
            for (size_t b : w.bends) link(b);
            link(box_of_pin.at(w.to));
        }
        auto number = [this](const std::vector<size_t> &l) {
            for (size_t i = 0; i < l.size(); i++) boxes[l[i]].place = (i + 0.5) / l.size();
        };
        for (auto &l : layers) number(l);
        for (int sweep = 0; sweep < SWEEPS; sweep++)
            for (size_t n = 0; n < layers.size(); n++) {
                auto &l = layers[sweep % 2 ? layers.size() - 1 - n : n];
                std::map<size_t, double> mean;
                for (size_t i : l) {
                    double sum = boxes[i].place;
                    for (size_t j : neighbours[i]) sum += boxes[j].place;
                    mean[i] = sum / (neighbours[i].size() + 1);
                }
                std::stable_sort(l.begin(), l.end(), [&](size_t a, size_t b) { return mean[a] < mean[b]; });
                number(l);
            }
    }

    static std::string short_name(const Box &b, const Item *p)
    {
        return p->name.compare(0, b.name.size() + 1, b.name + ".") == 0 ? p->name.substr(b.name.size() + 1) : p->name;
    }

    static double text_width(const std::string &text) { return text.size() * LETTER; }

    void size(Box &b)
    {
        if (b.bend) {
            b.height = 4;
            return;
        }
        double left = 0, right = 0;
        for (auto *p : b.left) left = std::max(left, text_width(short_name(b, p)));
        for (auto *p : b.right) right = std::max(right, text_width(short_name(b, p)));
        b.width = std::max(left + right + 36, text_width(b.name) * 1.1 + 20);
        b.height = HEAD + ROW * std::max(b.left.size(), b.right.size()) + 6;
    }

    std::string label(const SignalItem &s) const { return s.name + " = " + value_packed(s.type, s.value); }

    void place()
    {
        std::vector<double> heights(layers.size(), 0);
        for (size_t n = 0; n < layers.size(); n++) {
            for (size_t i : layers[n]) {
                size(boxes[i]);
                heights[n] += boxes[i].height + GAP_Y;
            }
            height = std::max(height, heights[n]);
        }
        // Room for the labels: at the right of a source, at the left of an input nobody writes.
        std::vector<double> gap(layers.size() + 1, MIN_GAP_X);
        for (auto &w : wires) {
            double need = text_width(label(*w.signal)) + 40;
            if (w.from) gap[boxes[box_of_pin.at(w.from)].layer + 1] =
                    std::max(gap[boxes[box_of_pin.at(w.from)].layer + 1], need);
            else gap[boxes[box_of_pin.at(w.to)].layer] = std::max(gap[boxes[box_of_pin.at(w.to)].layer], need);
        }
        double floor = 0;
        double x = MARGIN + (layers.empty() ? 0 : gap[0] - MIN_GAP_X / 2);
        for (size_t n = 0; n < layers.size(); n++) {
            double widest = 0, y = MARGIN + (height - heights[n]) / 2;
            for (size_t i : layers[n]) {
                boxes[i].x = x;
                boxes[i].y = y;
                y += boxes[i].height + GAP_Y;
                widest = std::max(widest, boxes[i].width);
            }
            for (size_t i : layers[n]) {
                boxes[i].width = widest;
                floor = std::max(floor, boxes[i].y + boxes[i].height);
            }
            x += widest + gap[n + 1];
        }
        width = x + MARGIN;
        // Lines that run back go below the boxes, one beside the other.
        double below = floor + 10;
        for (auto &w : wires)
            if (runs_back(w)) {
                lane[&w] = below;
                below += 7;
            }
        height = std::max(height + 2 * MARGIN, below + MARGIN);
    }

    bool runs_back(const Wire &w) const
    {
        return w.from && w.to && boxes[box_of_pin.at(w.to)].layer <= boxes[box_of_pin.at(w.from)].layer;
    }

    /// Where the line of a pin meets its box.
    void end_of(const Item *pin, double &x, double &y) const
    {
        const Box &b = boxes[box_of_pin.at(pin)];
        bool left = pin->dir == HAL_IN;
        auto &rows = left ? b.left : b.right;
        size_t row = std::find(rows.begin(), rows.end(), pin) - rows.begin();
        x = left ? b.x : b.x + b.width;
        y = b.y + HEAD + ROW * (row + 0.5);
    }

    std::string wire(const Wire &w, bool with_label) const
    {
        const SignalItem &s = *w.signal;
        const char *color = color_of(s.type, s.value);
        std::string tip = strf("<title>%s (%s)</title>", escaped(label(s)).c_str(), type_word(s.type));
        const double stub = text_width(label(s)) + 14;
        double x1, y1, x2, y2;
        std::string t = "<g>" + tip;
        if (w.from && w.to) {
            end_of(w.from, x1, y1);
            end_of(w.to, x2, y2);
            t += strf("<path d=\"M%.1f %.1f", x1, y1);
            // Inputs are entered from the left; a second I/O pin from its own (right) side.
            const double side = w.to->dir == HAL_IN ? -1 : 1;
            if (runs_back(w)) {
                const double y = lane.at(&w), out = x1 + 16, in = x2 + side * 16;
                t += strf(" C%.1f %.1f %.1f %.1f %.1f %.1f L%.1f %.1f C%.1f %.1f %.1f %.1f %.1f %.1f", out + 24, y1,
                          out + 24, y, out, y, in, y, in + side * 24, y, in + side * 24, y2, x2, y2);
            } else {
                auto curve = [&](double x, double y, double bend, double entry) {
                    t += strf(" C%.1f %.1f %.1f %.1f %.1f %.1f", x1 + bend, y1, x + entry * bend, y, x, y);
                    x1 = x;
                    y1 = y;
                };
                for (size_t b : w.bends) {
                    curve(boxes[b].x, boxes[b].y, (boxes[b].x - x1) / 2, -1);
                    x1 += boxes[b].width;
                    t += strf(" L%.1f %.1f", x1, y1);
                }
                curve(x2, y2, std::max(40.0, (x2 - x1) / 2), side);
            }
            t += strf("\" fill=\"none\" stroke=\"%s\" stroke-width=\"%s\"/>", color,
                      s.type == HAL_BIT && s.value.b ? "2.2" : "1.4");
        } else if (w.from) {
            end_of(w.from, x1, y1);
            t += strf("<path d=\"M%.1f %.1fh%.1f\" stroke=\"%s\" stroke-dasharray=\"4 3\"/>", x1, y1, stub, color);
        } else {
            end_of(w.to, x1, y1);
            t += strf("<path d=\"M%.1f %.1fh%.1f\" stroke=\"%s\" stroke-dasharray=\"4 3\"/>", x1, y1, -stub, color);
        }
        if (!with_label) return t + "</g>\n";
        if (w.from) end_of(w.from, x1, y1);
        else end_of(w.to, x1, y1);
        t += strf("<text x=\"%.1f\" y=\"%.1f\" fill=\"%s\"%s>%s</text></g>\n", w.from ? x1 + 8 : x1 - 8, y1 - 3, color,
                  w.from ? "" : " text-anchor=\"end\"", escaped(label(s)).c_str());
        return t;
    }

    std::string pin_row(const Box &b, const Item *p) const
    {
        double x, y;
        end_of(p, x, y);
        bool left = p->dir == HAL_IN;
        return strf("<g><title>%s %s %s = %s</title><circle cx=\"%.1f\" cy=\"%.1f\" r=\"3.2\" fill=\"%s\"/>"
                    "<text x=\"%.1f\" y=\"%.1f\"%s>%s</text></g>\n",
                    type_word(p->type), dir_word(p->dir), escaped(p->name).c_str(),
                    value_packed(p->type, p->value).c_str(), x, y, color_of(p->type, p->value),
                    left ? x + 7 : x - 7, y + 4, left ? "" : " text-anchor=\"end\"", escaped(short_name(b, p)).c_str());
    }

    std::string box(const Box &b) const
    {
        std::string t = strf("<g><title>component %s</title><rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" "
                             "rx=\"4\" fill=\"#eef1f4\" stroke=\"#5b6672\"/>"
                             "<text x=\"%.1f\" y=\"%.1f\" font-size=\"12\" font-weight=\"bold\">%s</text></g>\n",
                             escaped(b.comp).c_str(), b.x, b.y, b.width, b.height, b.x + 8, b.y + 15,
                             escaped(b.name).c_str());
        for (auto *p : b.left) t += pin_row(b, p);
        for (auto *p : b.right) t += pin_row(b, p);
        return t;
    }
};

} // namespace

int do_graph(Session &s, const Args &args)
{
    const Patterns wanted(args.size() > 1 ? args.begin() + 1 : args.end(), args.end());
    const std::string svg = Picture(wanted).svg();
    if (args.empty() || args[0] == "-") {
        s.output(svg);
        return 0;
    }
    FILE *file = fopen(args[0].c_str(), "we");
    bool written = file && fwrite(svg.data(), 1, svg.size(), file) == svg.size();
    if (file) written = fclose(file) == 0 && written;
    if (!written) {
        s.error(strf("Can't write graph to '%s': %s", args[0].c_str(), strerror(errno)));
        return -EIO;
    }
    return 0;
}

} // namespace halcmd
