/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * ini_tcl.cc - Tcl commands that read INI files (part of package Linuxcnc).
 *
 *   emc_ini VAR SEC ?DEFAULT?                       text, "" when missing
 *   emc_ini_real|int|wideint|bool VAR SEC ?DEFAULT? typed; an error when missing without DEFAULT
 *   emc_ini_sections                                names in file order
 *   emc_ini_variables SEC                           list of {name value}
 *   emc_ini_filename                                present file
 *   emc_ini_load FILE                               1 or 0; sets the global EMC_INIFILE
 *
 * Thread: [task]. Source: INI reference, section 4 (Tcl).
 */
#include "emc_tcl.hh"
#include "inifile.hh"

#include <string>
#include <tcl.h>

using linuxcnc::IniFile;

namespace
{

struct State {
    std::string name = "emc.ini";
    IniFile ini;

    /// The file, opened on first use.
    IniFile &file()
    {
        if (!ini) ini.open(name);
        return ini;
    }
};

Tcl_Obj *text_of(const std::string &s) { return Tcl_NewStringObj(s.data(), static_cast<int>(s.size())); }

template <class Value, class Find, class Make>
int typed(ClientData data, Tcl_Interp *interp, int argc, Tcl_Obj *const argv[], Find find, Make make)
{
    if (argc != 3 && argc != 4) {
        Tcl_WrongNumArgs(interp, 1, argv, "VAR SEC ?DEFAULT?");
        return TCL_ERROR;
    }
    auto &ini = static_cast<State *>(data)->file();
    std::optional<Value> value = find(ini, Tcl_GetString(argv[1]), Tcl_GetString(argv[2]));
    if (!value && argc == 3) {
        Tcl_SetObjResult(interp, Tcl_ObjPrintf("%s: [%s]%s not found", Tcl_GetString(argv[0]), Tcl_GetString(argv[2]),
                                               Tcl_GetString(argv[1])));
        return TCL_ERROR;
    }
    Tcl_SetObjResult(interp, value ? make(*value) : argv[3]);
    return TCL_OK;
}

int ini_text(ClientData data, Tcl_Interp *interp, int argc, Tcl_Obj *const argv[])
{
    if (argc != 3 && argc != 4) {
        Tcl_WrongNumArgs(interp, 1, argv, "VAR SEC ?DEFAULT?");
        return TCL_ERROR;
    }
    auto value = static_cast<State *>(data)->file().findString(Tcl_GetString(argv[1]), Tcl_GetString(argv[2]));
    if (value) Tcl_SetObjResult(interp, text_of(*value));
    else if (argc == 4) Tcl_SetObjResult(interp, argv[3]);
    return TCL_OK;
}

int ini_real(ClientData data, Tcl_Interp *interp, int argc, Tcl_Obj *const argv[])
{
    return typed<double>(
        data, interp, argc, argv, [](IniFile &i, const char *v, const char *s) { return i.findReal(v, s); },
        [](double v) { return Tcl_NewDoubleObj(v); });
}

int ini_int(ClientData data, Tcl_Interp *interp, int argc, Tcl_Obj *const argv[])
{
    return typed<int>(
        data, interp, argc, argv, [](IniFile &i, const char *v, const char *s) { return i.findInt(v, s); },
        [](int v) { return Tcl_NewIntObj(v); });
}

int ini_wideint(ClientData data, Tcl_Interp *interp, int argc, Tcl_Obj *const argv[])
{
    return typed<int64_t>(
        data, interp, argc, argv, [](IniFile &i, const char *v, const char *s) { return i.findSInt(v, s); },
        [](int64_t v) { return Tcl_NewWideIntObj(v); });
}

int ini_bool(ClientData data, Tcl_Interp *interp, int argc, Tcl_Obj *const argv[])
{
    return typed<bool>(
        data, interp, argc, argv, [](IniFile &i, const char *v, const char *s) { return i.findBool(v, s); },
        [](bool v) { return Tcl_NewBooleanObj(v); });
}

int ini_sections(ClientData data, Tcl_Interp *interp, int argc, Tcl_Obj *const argv[])
{
    if (argc != 1) {
        Tcl_WrongNumArgs(interp, 1, argv, nullptr);
        return TCL_ERROR;
    }
    Tcl_Obj *list = Tcl_NewListObj(0, nullptr);
    for (auto &name : static_cast<State *>(data)->file().findSections())
        Tcl_ListObjAppendElement(interp, list, text_of(name));
    Tcl_SetObjResult(interp, list);
    return TCL_OK;
}

int ini_variables(ClientData data, Tcl_Interp *interp, int argc, Tcl_Obj *const argv[])
{
    if (argc != 2) {
        Tcl_WrongNumArgs(interp, 1, argv, "SEC");
        return TCL_ERROR;
    }
    Tcl_Obj *list = Tcl_NewListObj(0, nullptr);
    for (auto &v : static_cast<State *>(data)->file().findVariables(Tcl_GetString(argv[1]))) {
        Tcl_Obj *pair[] = {text_of(v.name), text_of(v.value)};
        Tcl_ListObjAppendElement(interp, list, Tcl_NewListObj(2, pair));
    }
    Tcl_SetObjResult(interp, list);
    return TCL_OK;
}

int ini_filename(ClientData data, Tcl_Interp *interp, int, Tcl_Obj *const[])
{
    Tcl_SetObjResult(interp, text_of(static_cast<State *>(data)->name));
    return TCL_OK;
}

int ini_load(ClientData data, Tcl_Interp *interp, int argc, Tcl_Obj *const argv[])
{
    if (argc != 2) {
        Tcl_WrongNumArgs(interp, 1, argv, "FILE");
        return TCL_ERROR;
    }
    auto &state = *static_cast<State *>(data);
    state.name = Tcl_GetString(argv[1]);
    state.ini = IniFile(state.name);
    Tcl_SetVar(interp, "EMC_INIFILE", state.name.c_str(), TCL_GLOBAL_ONLY);
    Tcl_SetObjResult(interp, Tcl_NewIntObj(state.ini ? 1 : 0));
    return TCL_OK;
}

void destroy(ClientData data, Tcl_Interp *) { delete static_cast<State *>(data); }

} // namespace

extern "C" int Linuxcnc_Init(Tcl_Interp *interp)
{
    if (!Tcl_InitStubs(interp, "8.6", 0)) return TCL_ERROR;
    auto *state = new State;
    static const struct {
        const char *name;
        Tcl_ObjCmdProc *function;
    } commands[] = {{"emc_ini", ini_text},         {"emc_ini_real", ini_real},
                    {"emc_ini_int", ini_int},      {"emc_ini_wideint", ini_wideint},
                    {"emc_ini_bool", ini_bool},    {"emc_ini_sections", ini_sections},
                    {"emc_ini_load", ini_load},    {"emc_ini_variables", ini_variables},
                    {"emc_ini_filename", ini_filename}};
    for (auto &c : commands) Tcl_CreateObjCommand(interp, c.name, c.function, state, nullptr);
    Tcl_CallWhenDeleted(interp, destroy, state);
    return emc_tcl_init(interp);
}
