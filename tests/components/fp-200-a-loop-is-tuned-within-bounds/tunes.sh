# SPDX-License-Identifier: GPL-2.0-or-later
tune() {
    echo "== $*"
    pid-tune --yes "$@" 2>&1
    echo "status $?: $(for g in Pgain Igain Dgain FF1 tune-mode bias; do halcmd getp "$1.$g"; done 2>/dev/null | tr '\n' ' ')"
}
tune speed --most-error 0.5 --effort 20
halcmd setp speed.Pgain 20
halcmd setp speed.Igain 0
halcmd setp speed.Dgain 0
tune speed --most-error 0.5 --effort 20 --pi
tune current --most-error 0.5 --effort 50
tune wrong --most-error 0.5 --effort 20
tune linked --most-error 0.5
tune nobody --most-error 0.5
tune speed --most-error 0.5 --seconds 0.05
halcmd setp speed.enable 0
tune speed --most-error 0.5
pid-tune speed --most-error -1 2>&1 | tail -1
