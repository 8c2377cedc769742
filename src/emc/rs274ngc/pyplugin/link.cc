/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * link.cc - the Python plugin: handlers, O-word subs, comments, named parameters.
 *
 * Python is started once in a process, by whoever needs it first; interpreters share it.
 * Thread: [task]
 * Source: remap sheet, sections 1, 6 and 7
 */
#include <sys/stat.h>

#include <pybind11/embed.h>

#include <cmath>

#include "py_interp.hh"
#include "python_link.hh"
#include "stages.hh"

namespace py = pybind11;

namespace ngc
{
namespace
{

enum ConfigureStatus {
    PLUGIN_OK = 0,
    NO_TOPLEVEL = -4,
    BAD_PATH = -5,
    STAT_FAILED = -6,
    EXCEPTION_DURING_PATH_PREPEND = -9,
    EXCEPTION_DURING_PATH_APPEND = -10,
    INIT_EXCEPTION = -11
};

void start_python()
{
    if (!Py_IsInitialized()) {
        PyConfig config;
        PyConfig_InitPythonConfig(&config);
        config.install_signal_handlers = 0; // signals belong to the host program
        config.buffered_stdio = 0;
        config.parse_argv = 0;
        Py_InitializeFromConfig(&config);
        PyConfig_Clear(&config);
    }
    install_modules();
}

std::string type_name(const py::handle &h) { return py::str(h.get_type().attr("__name__")); }

// str() of anything; characters that UTF-8 has not are escaped.
std::string text_of(const py::handle &h)
{
    return py::str(h).attr("encode")("utf-8", "backslashreplace").cast<std::string>();
}

// An exception's traceback as Python would print it.
std::string traceback_of(py::error_already_set &e)
{
    try {
        py::object format = py::module_::import("traceback").attr("format_exception");
        py::list lines = format(e.type(), e.value(), e.trace() ? e.trace() : py::none());
        return text_of(py::str("").attr("join")(lines));
    } catch (py::error_already_set &) {
        return e.what();
    }
}

std::string absolute_path(const std::string &path)
{
    char *real = realpath(expand_path(path).c_str(), nullptr);
    std::string result = real ? real : "";
    free(real);
    return result;
}

/// A generator that waits until the machine has done its work.
struct Waiting {
    py::object generator;
    int call_level;
    bool oword;
    bool waited;
    std::string name;
};

class Link final : public PythonLink
{
  public:
    Link(Setup &s, Interp *interp)
    {
        start_python();
        py::gil_scoped_acquire gil;
        PyInterp handle;
        handle.setup = &s;
        handle.interp = interp;
        self = py::cast(handle);
    }
    ~Link() override
    {
        py::gil_scoped_acquire gil;
        self.cast<PyInterp &>().setup = nullptr;
        waiting.clear();
        self = py::object();
        main_dict = py::object();
    }

    int configure(Setup &s) override
    {
        py::gil_scoped_acquire gil;
        current_setup() = &s;
        auto toplevel = s.ini.findString("TOPLEVEL", "PYTHON");
        if (!toplevel) return NO_TOPLEVEL;
        log_level = s.ini.findIntV("LOG_LEVEL", "PYTHON", 0);
        reload_on_change = s.ini.findBoolV("RELOAD_ON_CHANGE", "PYTHON", false);
        const std::string path = absolute_path(*toplevel);
        if (path.empty()) {
            s.canon.operator_error(("can't resolve path to '" + *toplevel + "'").c_str());
            return BAD_PATH;
        }
        py::list search = py::module_::import("sys").attr("path");
        for (const std::string &dir : s.ini.findStringAll("PATH_PREPEND", "PYTHON")) {
            const std::string real = absolute_path(dir);
            if (real.empty()) {
                s.canon.operator_error(("can't resolve path to '" + dir + "'").c_str());
                return BAD_PATH;
            }
            search.insert(0, real);
        }
        for (const std::string &dir : s.ini.findStringAll("PATH_APPEND", "PYTHON")) {
            const std::string real = absolute_path(dir);
            if (real.empty()) {
                s.canon.operator_error(("can't resolve path to '" + dir + "'").c_str());
                return BAD_PATH;
            }
            search.append(real);
        }
        toplevel_path = path;
        return run_toplevel() ? PLUGIN_OK : INIT_EXCEPTION;
    }

    bool callable(const char *module, const std::string &name) override
    {
        if (!usable && !reload_on_change) return false;
        py::gil_scoped_acquire gil;
        refresh();
        return bool(function(module, name));
    }

    int call_remap(Setup &s, const std::string &name, const RemapFrame &frame) override
    {
        py::gil_scoped_acquire gil;
        Entry entry(*this, s);
        py::dict words;
        for (const auto &[letter, value] : frame.words) words[py::str(&letter, 1)] = value;
        py::object result;
        TRY(call(s, "remap", name, py::tuple(), words, &result));
        return guarded(s, name, [&] { return handler_result(s, "remap", name, result); });
    }

    int call_oword(Setup &s, const std::string &name, const double *params, int count) override
    {
        py::gil_scoped_acquire gil;
        Entry entry(*this, s);
        s.value_returned = false;
        s.return_value = 0;
        py::tuple args(static_cast<size_t>(count));
        for (int i = 0; i < count; ++i) args[size_t(i)] = params[i];
        py::object result;
        if (call(s, "oword", name, args, py::dict(), &result) != INTERP_OK)
            FAIL("pycall(oword.%s) failed", name.c_str());
        return guarded(s, name, [&] { return oword_result(s, name, result); });
    }

    int waiting_level() const override { return waiting.empty() ? -1 : waiting.back().call_level; }

    int resume(Setup &s, bool *oword) override
    {
        py::gil_scoped_acquire gil;
        Entry entry(*this, s);
        Waiting w = std::move(waiting.back());
        waiting.pop_back();
        *oword = w.oword;
        return guarded(s, w.name, [&] { return run_generator(s, w); });
    }

    void forget_waiting() override
    {
        if (waiting.empty()) return;
        py::gil_scoped_acquire gil;
        waiting.clear();
    }

    int run(Setup &s, const char *text, bool file) override
    {
        py::gil_scoped_acquire gil;
        Entry entry(*this, s);
        refresh();
        try {
            if (file) {
                py::eval_file(py::str(expand_path(linuxcnc::IniFile::trim(text))), main_dict);
            } else {
                py::exec(py::str(text), main_dict);
            }
        } catch (py::error_already_set &e) {
            const std::string trace = traceback_of(e);
            fprintf(stderr, "run_string(%s): \n%s", text, trace.c_str());
            FAIL("py_execute(%s)%s:\n%s", text, file ? " as file" : "", trace.c_str());
        } catch (std::exception &e) { // of a file that cannot be read
            FAIL("py_execute(%s)%s:\n%s", text, file ? " as file" : "", e.what());
        }
        return INTERP_OK;
    }

    int reload(Setup &s) override
    {
        py::gil_scoped_acquire gil;
        Entry entry(*this, s);
        run_toplevel();
        return INTERP_OK;
    }

    int named_value(Setup &s, const std::string &name, double *value) override
    {
        py::gil_scoped_acquire gil;
        Entry entry(*this, s);
        py::object f = function("namedparams", name);
        CHECK(!f, "Named parameter #<%s> not defined", name.c_str());
        py::object result;
        try {
            result = f(self);
        } catch (py::error_already_set &e) {
            FAIL("named param - pycall(%s):\n%s", name.c_str(), traceback_of(e).c_str());
        }
        return guarded(s, name, [&] { return value_of(s, name, result, value); });
    }

    int first_init(Setup &s) override
    {
        if (initialised) return INTERP_OK;
        initialised = true;
        py::gil_scoped_acquire gil;
        Entry entry(*this, s);
        TRY(guarded(s, "namedparams", [&] { return export_named_parameters(s); }));
        if (!main_dict.contains("__init__")) return INTERP_OK;
        py::object init = main_dict["__init__"];
        try {
            py::object result = init(self);
            if (PyLong_Check(result.ptr()) && py::int_(int(INTERP_MIN_ERROR)) < result) {
                CHECK(s.error.empty(), "__init__ returned %s", text_of(result).c_str());
                return INTERP_ERROR;
            }
        } catch (py::error_already_set &e) {
            usable = false;
            const std::string trace = traceback_of(e);
            fprintf(stderr, "call(__init__): \n%s", trace.c_str());
            FAIL("pycall(__init__):\n%s", trace.c_str());
        }
        return INTERP_OK;
    }

    void at_exit(Setup &s) override
    {
        if (!usable) return;
        py::gil_scoped_acquire gil;
        Entry entry(*this, s);
        if (!main_dict || !main_dict.contains("__delete__")) return;
        try {
            main_dict["__delete__"](self);
        } catch (py::error_already_set &e) {
            fprintf(stderr, "call(__delete__): \n%s", traceback_of(e).c_str());
        }
    }

  private:
    /// While Python code runs: whose canon and which `this` it sees.
    struct Entry {
        Setup *const before;
        Entry(Link &link, Setup &s) : before(current_setup())
        {
            current_setup() = &s;
            s.canon.flush_output();
            py::module_::import("interpreter").attr("this") = link.self;
        }
        ~Entry() { current_setup() = before; }
    };

    /// What a handler gave is looked at: whatever it is, the interpreter lives on.
    template <class Work> static int guarded(Setup &s, const std::string &name, Work work)
    {
        try {
            return work();
        } catch (py::error_already_set &e) {
            FAIL("pycall(%s):\n%s", name.c_str(), traceback_of(e).c_str());
        } catch (std::exception &e) {
            FAIL("pycall(%s):\n%s", name.c_str(), e.what());
        }
    }

    static int value_of(Setup &s, const std::string &name, const py::object &result, double *value)
    {
        CHECK(result.is_none(), "Python namedparams.%s returns no value", name.c_str());
        if (PyFloat_Check(result.ptr()) || PyLong_Check(result.ptr())) {
            *value = result.cast<double>();
            return INTERP_OK;
        }
        const std::string text = text_of(result);
        CHECK(PyUnicode_Check(result.ptr()), "%s", text.c_str());
        FAIL("Python call namedparams.%s returned '%s' - expected double, int or string, got %s", name.c_str(),
             text.c_str(), type_name(result).c_str());
    }

    bool run_toplevel()
    {
        struct stat st;
        if (stat(toplevel_path.c_str(), &st) == 0) toplevel_time = st.st_mtim;
        main_dict = py::module_::import("__main__").attr("__dict__");
        try {
            py::module_::import("interpreter").attr("this") = self;
            py::exec("import interpreter\nimport emccanon\nfrom interpreter import this\n", main_dict);
            main_dict["this"] = self;
            py::eval_file(py::str(toplevel_path), main_dict);
            usable = true;
        } catch (py::error_already_set &e) {
            usable = false;
            fprintf(stderr, "initialize: module '%s' init failed: \n%s", toplevel_path.c_str(),
                    traceback_of(e).c_str());
        } catch (std::exception &e) { // of a file that cannot be read
            usable = false;
            fprintf(stderr, "initialize: module '%s' init failed: \n%s\n", toplevel_path.c_str(), e.what());
        }
        return usable;
    }

    // The file is read again when it is newer than what runs.
    void refresh()
    {
        if (!reload_on_change) return;
        struct stat st;
        if (stat(toplevel_path.c_str(), &st) != 0) return;
        if (st.st_mtim.tv_sec == toplevel_time.tv_sec && st.st_mtim.tv_nsec == toplevel_time.tv_nsec) return;
        run_toplevel();
    }

    /// module.name if it can be called, else nothing.
    py::object function(const char *module, const std::string &name)
    {
        if (!main_dict || !main_dict.contains(module)) return {};
        py::object m = main_dict[module];
        if (!py::hasattr(m, name.c_str())) return {};
        py::object f = m.attr(name.c_str());
        return PyCallable_Check(f.ptr()) ? f : py::object();
    }

    int call(Setup &s, const char *module, const std::string &name, const py::tuple &args, const py::dict &words,
             py::object *result)
    {
        refresh();
        py::object f = function(module, name);
        CHECK(!f, "pycall(%s.%s) failed", module, name.c_str());
        try {
            *result = f(self, *args, **words);
        } catch (py::error_already_set &e) {
            const std::string trace = traceback_of(e);
            fprintf(stderr, "call(%s.%s): \n%s", module, name.c_str(), trace.c_str());
            FAIL("pycall(%s):\n%s", name.c_str(), trace.c_str());
        }
        return INTERP_OK;
    }

    static int status_of(Setup &s, const py::object &result)
    {
        const int value = result.cast<int>();
        if (value >= INTERP_OK && value <= INTERP_EXECUTE_FINISH) return value;
        // The handler has given its text with set_errormsg(); without one something must be said.
        if (s.error.empty())
            s.error = "the handler returned " + (value == INTERP_ERROR ? "INTERP_ERROR" : std::to_string(value)) +
                      " without a message";
        s.fault.what = s.error;
        fill_fault_place(s);
        return INTERP_ERROR;
    }

    static bool is_status(const py::object &value) { return PyLong_Check(value.ptr()); }

    int handler_result(Setup &s, const char *module, const std::string &name, const py::object &result)
    {
        if (result.is_none()) return INTERP_OK;
        if (is_status(result)) {
            const int status = status_of(s, result);
            if (status == INTERP_EXECUTE_FINISH) // returned: there is nothing to go on with after the wait
                wait({py::iter(py::tuple()), s.call_level, false, true, name});
            return status;
        }
        if (PyGen_Check(result.ptr())) {
            Waiting w{result, s.call_level, false, false, name};
            return run_generator(s, w);
        }
        const std::string text = text_of(result);
        CHECK(PyUnicode_Check(result.ptr()), "%s", text.c_str());
        CHECK(PyFloat_Check(result.ptr()), "handler_returned: %s returned double: %f - invalid", name.c_str(),
              result.cast<double>());
        FAIL("Python call %s.%s returned '%s' - expected generator, int, or float value, got %s", module, name.c_str(),
             text.c_str(), type_name(result).c_str());
    }

    int oword_result(Setup &s, const std::string &name, const py::object &result)
    {
        if (result.is_none()) return INTERP_OK;
        if (PyGen_Check(result.ptr())) {
            Waiting w{result, s.call_level, true, false, name};
            return run_generator(s, w);
        }
        if (PyFloat_Check(result.ptr()) || PyLong_Check(result.ptr())) {
            s.return_value = result.cast<double>();
            s.value_returned = true;
            return INTERP_OK;
        }
        FAIL("pycall(oword.%s) failed", name.c_str());
    }

    // What it has called, and waits too, goes on before it.
    void wait(Waiting w)
    {
        auto place = waiting.end();
        while (place != waiting.begin() && (place - 1)->call_level > w.call_level) --place;
        waiting.insert(place, std::move(w));
    }

    // The next step of a generator. It stays waiting when it yields INTERP_EXECUTE_FINISH.
    int run_generator(Setup &s, Waiting &w)
    {
        py::object value;
        PyObject *raw = PyIter_Next(w.generator.ptr());
        if (!raw) {
            if (!PyErr_Occurred()) return INTERP_OK;
            py::error_already_set e;
            const std::string trace = traceback_of(e);
            fprintf(stderr, "%s: \n%s", w.name.c_str(), trace.c_str());
            FAIL("exception during generator call: %s", trace.c_str());
        }
        value = py::reinterpret_steal<py::object>(raw);
        CHECK(PyGen_Check(value.ptr()) || (value.is_none() && !w.oword),
              "Python generator %s yielded '%s' - expected int, got %s", w.name.c_str(), text_of(value).c_str(),
              type_name(value).c_str());
        // What an O-word sub yields after it has waited is its value; INTERP_EXECUTE_FINISH is no plain number.
        const bool its_value = w.oword && (!is_status(value) || (w.waited && PyLong_CheckExact(value.ptr())));
        if (!its_value && is_status(value) && value.equal(py::int_(int(INTERP_EXECUTE_FINISH)))) {
            w.waited = true;
            wait(std::move(w));
            return INTERP_EXECUTE_FINISH;
        }
        if (its_value) return oword_result(s, w.name, value);
        return handler_result(s, "remap", w.name, value);
    }

    int export_named_parameters(Setup &s)
    {
        if (!main_dict || !main_dict.contains("namedparams")) return INTERP_OK;
        py::object module = main_dict["namedparams"];
        for (py::handle key : py::list(py::module_::import("builtins").attr("dir")(module))) {
            const std::string name = py::str(key);
            if (name.empty() || name[0] != '_' || name.compare(0, 2, "__") == 0) continue;
            if (!PyCallable_Check(py::object(module.attr(name.c_str())).ptr())) continue;
            if (s.globals.find(name)) fprintf(stderr, "warning: redefining named parameter %s\n", name.c_str());
            NamedParameter &p = s.globals.at(name);
            p.computed = nullptr;
            p.python = p.read_only = true;
        }
        return INTERP_OK;
    }

    py::object self, main_dict;
    std::string toplevel_path;
    struct timespec toplevel_time = {};
    std::vector<Waiting> waiting;
    bool usable = false; // TOPLEVEL has run to its end
    bool reload_on_change = false, initialised = false;
    int log_level = 0;
};

} // namespace
} // namespace ngc

extern "C" __attribute__((visibility("default"))) ngc::PythonLink *kerf_make_python_link(Setup &s, Interp *self)
{
    return new ngc::Link(s, self);
}
