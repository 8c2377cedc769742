/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * callbacks.cc - see callbacks.hh.
 *
 * Method: an exception of a callback travels through the interpreter, which is then
 *         dropped; nothing of it is used again.
 */
#include "callbacks.hh"

#include <unistd.h>

#include <ctime>
#include <memory>

#include "interp.hh"
#include "preview_canon.hh"

namespace py = pybind11;

namespace
{

std::string saved_error;

enum BatchKind { TRAVERSE, FEED, PROBE, TAP, DWELL_ROW, USER_M, TOOL_CHANGE, TOOL_OFFSET_ROW };
enum { ROW = 13, ROWS = 16384 };

// A bound method of the canon; called without pybind's argument packing.
class Method
{
  public:
    Method(const py::object &canon, const char *name)
    {
        if (py::hasattr(canon, name)) bound = canon.attr(name);
        method_name = name;
    }
    explicit operator bool() const { return bool(bound); }
    template <class... Args> void operator()(Args... args)
    {
        PyObject *raw[] = {nullptr, to_python(args)...};
        const size_t n = sizeof...(args);
        PyObject *result = nullptr;
        if (!bound) PyErr_Format(PyExc_AttributeError, "the canon has no method %s", method_name);
        else result = PyObject_Vectorcall(bound.ptr(), raw + 1, n | PY_VECTORCALL_ARGUMENTS_OFFSET, nullptr);
        for (size_t i = 1; i <= n; ++i) Py_XDECREF(raw[i]);
        if (!result) throw py::error_already_set();
        Py_DECREF(result);
    }
    void pose(const EmcPose &p)
    {
        (*this)(p.tran.x, p.tran.y, p.tran.z, p.a, p.b, p.c, p.u, p.v, p.w);
    }

  private:
    static PyObject *to_python(double v) { return PyFloat_FromDouble(v); }
    static PyObject *to_python(int v) { return PyLong_FromLong(v); }
    static PyObject *to_python(const char *v)
    {
        PyObject *text = PyUnicode_DecodeUTF8(v, Py_ssize_t(strlen(v)), "surrogateescape");
        return text ? text : PyUnicode_FromString("");
    }
    static PyObject *to_python(py::handle v) { return v.inc_ref().ptr(); }

    py::object bound;
    const char *method_name;
};

double exact_float(const py::object &canon, const char *method)
{
    py::object value = canon.attr(method)();
    if (!PyFloat_Check(value.ptr())) throw py::type_error(std::string(method) + "() must return a float");
    return PyFloat_AsDouble(value.ptr());
}

class CallbackCanon final : public PreviewCanon
{
  public:
    explicit CallbackCanon(const py::object &c)
        : canon(c), m_next_line(c, "next_line"), m_traverse(c, "straight_traverse"), m_feed(c, "straight_feed"),
          m_probe(c, "straight_probe"), m_tap(c, "rigid_tap"), m_arc(c, "arc_feed"), m_dwell(c, "dwell"),
          m_comment(c, "comment"), m_message(c, "message"), m_user(c, "user_defined_function"),
          m_g5x(c, "set_g5x_offset"), m_g92(c, "set_g92_offset"), m_rotation(c, "set_xy_rotation"),
          m_plane(c, "set_plane"), m_feed_rate(c, "set_feed_rate"), m_change(c, "change_tool"),
          m_offset(c, "tool_offset"), m_batch(c, "move_batch")
    {
        if (py::hasattr(c, "use_move_batches") && c.attr("use_move_batches").ptr() == Py_True) {
            if (!m_batch || !PyCallable_Check(py::object(c.attr("move_batch")).ptr()))
                throw py::type_error("parse: canon sets use_move_batches but has no callable move_batch");
            batching = true;
            rows.reserve(size_t(ROW) * ROWS);
        }
        units_per_mm = exact_float(c, "get_external_length_units");
        units_per_degree = exact_float(c, "get_external_angular_units");
        mask = canon.attr("get_axis_mask")().cast<int>();
        get_tool = canon.attr("get_tool");
        if (py::hasattr(c, "parameter_file"))
            parameter_name = c.attr("parameter_file").cast<std::filesystem::path>().string();
    }
    Interp *interp = nullptr;

    double GET_EXTERNAL_LENGTH_UNITS() override { return units_per_mm; }
    double GET_EXTERNAL_ANGLE_UNITS() override { return units_per_degree; }
    int GET_EXTERNAL_AXIS_MASK() override { return mask; }
    std::string GET_EXTERNAL_PARAMETER_FILE_NAME() override { return parameter_name; }
    bool GET_BLOCK_DELETE() override { return py::bool_(canon.attr("get_block_delete")()); }
    CANON_TOOL_TABLE GET_EXTERNAL_TOOL_TABLE(int idx) override
    {
        py::tuple t = get_tool(idx);
        CANON_TOOL_TABLE r = tooldata_entry_init();
        r.toolno = r.pocketno = t[0].cast<int>();
        double *offset = &r.offset.tran.x;
        for (size_t i = 0; i < 9; ++i) offset[i] = t[i + 1].cast<double>();
        r.diameter = t[10].cast<double>();
        r.frontangle = t[11].cast<double>();
        r.backangle = t[12].cast<double>();
        r.orientation = t[13].cast<int>();
        return r;
    }
    void print_line(const char *text) override { py::print(py::str(text, strlen(text))); }
    void CHANGE_TOOL_NUMBER(int) override { announce(); }

    /// Before a line is executed: its codes are those of the moment.
    void take_codes()
    {
        interp->active_g_codes(code.g);
        interp->active_m_codes(code.m);
        interp->active_settings(code.settings);
    }
    void announce() { announce(interp->sequence_number()); }
    /// A move that compensation has held back belongs to a line before the one being read.
    void announce(int line)
    {
        if (line < 0) line = interp->sequence_number();
        if (line == delivered || preparing) return;
        delivered = line;
        code.g[0] = code.m[0] = line;
        code.settings[0] = line;
        m_next_line(py::handle(py::cast(code)));
    }
    int last_delivered() const { return delivered; }
    /// Init codes run at the line where the file begins: 0, or that of its %.
    void prepare(bool on)
    {
        if (on) {
            take_codes();
            announce();
        }
        preparing = on;
    }
    void flush_rows()
    {
        if (rows.empty()) return;
        if (in_batch)
            throw std::runtime_error(
                "gcode.parse: the move batch belongs to a different canon - gcode.parse was re-entered");
        in_batch = true;
        py::memoryview view = py::memoryview::from_memory(static_cast<const void *>(rows.data()),
                                                          Py_ssize_t(rows.size() * sizeof(double)));
        m_batch(py::handle(view));
        in_batch = false;
        rows.clear();
    }

  protected:
    void on_g5x(int index, const EmcPose &o) override
    {
        forward();
        m_g5x(index, o.tran.x, o.tran.y, o.tran.z, o.a, o.b, o.c, o.u, o.v, o.w);
    }
    void on_g92(const EmcPose &o) override
    {
        forward();
        m_g92.pose(o);
    }
    void on_rotation(double degrees) override
    {
        forward();
        m_rotation(degrees);
    }
    void on_plane(int p) override
    {
        forward();
        m_plane(p);
    }
    void on_feed_rate(double rate) override
    {
        if (batching && feed_sent && rate == feed) return;
        feed = rate;
        feed_sent = true;
        announce();
        m_feed_rate(rate);
    }
    void on_tool_offset(int line, const EmcPose &o) override
    {
        if (batching) return add(TOOL_OFFSET_ROW, line, o);
        announce();
        m_offset.pose(o);
    }
    void on_traverse(int line, const EmcPose &end) override
    {
        if (batching) return add(TRAVERSE, line, end);
        announce(line);
        m_traverse.pose(end);
    }
    void on_feed(int line, const EmcPose &end) override
    {
        if (batching) return add(FEED, line, end);
        announce(line);
        m_feed.pose(end);
    }
    void on_probe(int line, const EmcPose &end) override
    {
        if (batching) return add(PROBE, line, end);
        announce(line);
        m_probe.pose(end);
    }
    void on_tap(int line, double x, double y, double z) override
    {
        if (batching) return add(TAP, line, xyz(x, y, z));
        announce(line);
        m_tap(x, y, z);
    }
    void on_arc(int line, double first_end, double second_end, double first_axis, double second_axis, int rotation,
                double axis_end, const EmcPose &p) override
    {
        forward(line);
        m_arc(first_end, second_end, first_axis, second_axis, rotation, axis_end, p.a, p.b, p.c, p.u, p.v, p.w);
    }
    void on_dwell(int line, double seconds) override
    {
        if (batching) return add(DWELL_ROW, line, xyz(seconds, 0, 0));
        announce();
        m_dwell(seconds);
    }
    void on_tool_change(int line, int toolno) override
    {
        if (batching) return add(TOOL_CHANGE, line, xyz(toolno, 0, 0));
        announce();
        m_change(toolno);
    }
    void on_comment(const char *text) override
    {
        forward();
        m_comment(text);
    }
    void on_message(const char *text) override
    {
        forward();
        m_message(text);
    }
    void on_user_m(int line, int num, double p, double q) override
    {
        if (batching) return add(USER_M, line, xyz(num, p, q));
        announce();
        m_user(num, p, q);
    }
    int last_line() override { return interp->sequence_number(); }

  private:
    static EmcPose xyz(double x, double y, double z)
    {
        EmcPose p{};
        p.tran.x = x;
        p.tran.y = y;
        p.tran.z = z;
        return p;
    }
    // Before a callback that is not batched.
    void forward() { forward(interp->sequence_number()); }
    void forward(int line)
    {
        if (batching) flush_rows();
        announce(line);
    }
    void add(BatchKind kind, int line, const EmcPose &p)
    {
        const double *v = &p.tran.x;
        rows.push_back(kind);
        rows.push_back(line);
        rows.insert(rows.end(), v, v + 9);
        rows.push_back(feed);
        rows.push_back(speed);
        if (rows.size() >= size_t(ROW) * ROWS) flush_rows();
    }

    py::object canon, get_tool;
    Method m_next_line, m_traverse, m_feed, m_probe, m_tap, m_arc, m_dwell, m_comment, m_message, m_user, m_g5x, m_g92,
        m_rotation, m_plane, m_feed_rate, m_change, m_offset, m_batch;
    double units_per_mm, units_per_degree;
    int mask;
    std::string parameter_name = "rs274ngc.var";
    LineCode code{};
    int delivered = -1;
    bool batching = false, in_batch = false, feed_sent = false, preparing = false;
    double feed = 60;
    std::vector<double> rows;
};

// An exception of check_abort() is not replaced.
struct AbortException {
    py::error_already_set error;
};

void check_abort(const py::object &canon, time_t *last)
{
    const time_t now = time(nullptr); // how long a person waits: wall time
    if (now - *last <= 1) return;
    *last = now;
    bool abort;
    try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        abort = py::bool_(canon.attr("check_abort")());
    } catch (py::error_already_set &e) {
        throw AbortException{e};
    }
    if (abort) {
        PyErr_SetString(PyExc_KeyboardInterrupt, "Load aborted");
        throw AbortException{py::error_already_set()};
    }
}

} // namespace

std::string last_error(int code) {
    return code == INTERP_FILE_NOT_OPEN ? "File not open" : code == INTERP_ERROR ? saved_error : "";
}

py::tuple parse_with_callbacks(const std::string &file, py::object canon_object,
                               const std::vector<std::string> &init_codes, const std::string &library)
{
    saved_error.clear();
    CallbackCanon canon(canon_object);
    std::string why;
    std::unique_ptr<Interp> interp = make_interpreter(library, canon, &why);
    if (!interp) throw py::value_error(why);
    canon.interp = interp.get();
    int status = INTERP_OK, opened = INTERP_OK, extra = 0;
    try {
        status = interp->init(InterpOptions::from_environment());
        if (status <= INTERP_MIN_ERROR) opened = interp->open(file.c_str());
        if (opened != INTERP_OK) saved_error = interp->error_text(INTERP_ERROR);
        canon.prepare(true);
        for (size_t i = 0; i < init_codes.size() && status <= INTERP_MIN_ERROR; ++i) {
            if (init_codes[i].empty()) continue;
            canon.take_codes();
            status = interp->execute(init_codes[i].c_str());
        }
        canon.prepare(false);
        time_t asked = time(nullptr);
        if (status <= INTERP_MIN_ERROR) status = INTERP_OK;
        if (opened != INTERP_OK && access(file.c_str(), R_OK) == 0) status = opened; // nothing in it
        int count = 0;
        while (status == INTERP_OK || status == INTERP_EXECUTE_FINISH) {
            extra = 1;
            status = interp->read();
            if (status != INTERP_OK && status != INTERP_EXECUTE_FINISH) break;
            extra = 0;
            canon.take_codes();
            status = interp->execute();
            if ((++count & 63) == 0) {
                const time_t before = asked;
                if (time(nullptr) - before > 1) canon.flush_rows();
                check_abort(canon_object, &asked);
            }
        }
        canon.flush_rows();
        if (status <= INTERP_MIN_ERROR) extra = 0;
    } catch (AbortException &abort) {
        throw py::error_already_set(std::move(abort.error));
    } catch (py::error_already_set &e) {
        if (e.matches(PyExc_KeyboardInterrupt)) throw; // (AXIS,stop): the part so far is the preview
        e.restore();
        PyErr_WriteUnraisable(canon_object.ptr());
        throw std::runtime_error("parse_file interp_error");
    }
    int line = canon.last_delivered() > 0 ? canon.last_delivered() : 0;
    if (status != INTERP_FILE_NOT_OPEN) canon.announce();
    if (status == INTERP_ENDFILE) line = canon.last_delivered() + 1; // behind the closing %
    if (status > INTERP_MIN_ERROR) {
        if (status == INTERP_ERROR && opened == INTERP_OK) saved_error = interp->error_text(status);
        const Fault &fault = interp->fault();
        line = status == INTERP_ERROR && fault.file == file ? fault.line : line + extra;
    }
    return py::make_tuple(status, line);
}
