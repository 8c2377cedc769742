#!/bin/bash
# Comments, quotes, continuation, substitution and their messages. No realtime process.
export KERF_T_WORD=one KERF_T_TWO='two words' KERF_T_EMPTY=
cat > t.ini <<'INI'
[NUM]
SIZE = 4096
EMPTY =
NAME_2 = underscored
[TEXT]
PAIR = sig_a bit
INI
run() { # name of the case; the file comes from standard input
    echo "# $1"
    cat > t.hal
    halcmd -k -i t.ini -f t.hal 2>&1
    echo "=> $?"
}
run comments <<'HAL'
# all of the line
   # with blanks before
newsig a bit # behind
newsig b#glued bit
list sig
print 'a # b'
print "c # d"
HAL
printf '\xef\xbb\xbf# saved by an editor for Windows\nnewsig marked bit\n' > marked.hal
printf '\xef\xbb\xbfsource marked.hal\nlist sig marked\ndelsig marked\n\xef\xbb\xbf\n' | run "a byte order mark at the begin, and one elsewhere"
rm marked.hal
run quotes <<'HAL'
print 'single run'
print "double 'in' run"
print pre"quoted blank"post
print 'open
print "open
setp x ''
HAL
run continuation <<'HAL'
newsig \
a \
bit
newsig b\
c bit
list sig
print last\
line
newsig trailing \
HAL
printf 'newsig pend bit\nprint dropped \\' > t.hal; echo "# pending at the end"; halcmd -k -f t.hal 2>&1; echo "=> $?"
run environment <<'HAL'
print $KERF_T_WORD
print $(KERF_T_WORD)
print "$(KERF_T_TWO)"
print $(KERF_T_TWO)
print $KERF_T_WORD.x
print a$(KERF_T_EMPTY)b
print $
print $()
print $(OPEN
print $KERF_T_NONE
print $(KERF_T_NONE)
HAL
run ini <<'HAL'
print [NUM]SIZE
print [NUM](SIZE)
print [NUM]NAME_2
print []SIZE
print '[NUM]SIZE'
newsig [TEXT]PAIR
list sig
setp x [NUM]EMPTY
print [NUM]NONE
print [num]SIZE
print [NONE]SIZE
print [
print []
print [NUM](SIZE
HAL
echo "# without -i"; echo 'print [NUM]SIZE' | halcmd -f 2>&1; echo "=> $?"
long=$(printf 'x%.0s' {1..130})
run limits <<HAL
print $(printf 'a %.0s' {1..40})
show $(printf '"a" %.0s' {1..30}) end
newsig $(printf '%.0sx' {1..31}) bit
print \$$long
print \$($long)
HAL
cat > long.hal <<HAL
print $(printf 'y%.0s' {1..1100})
print after
HAL
echo "# a line of more than 1023 characters"; halcmd -k -f long.hal 2>&1 | sed 's/y\{1000,\}/Y/; s/y\{50,\}/y/'
printf 'print dos\r\nprint two\r\n' > dos.hal; echo "# DOS"; halcmd -k -f dos.hal 2>&1; echo "=> $?"
printf 'print a\rb\n' > cr.hal; echo "# CR inside"; halcmd -k -f cr.hal 2>&1; echo "=> $?"
echo "# echo"; printf 'newsig a bit # c\n\nunecho\nprint no\necho\nfoo [X\nquit\nprint never\n' > t.hal; halcmd -k -e -f t.hal 2>&1; echo "=> $?"
echo "# source"
cat > inner.hal <<'HAL'
print inner
newsig in bit
nonsense
print never
HAL
run source <<'HAL'
source inner.hal
print outer
source missing.hal
list sig
HAL
printf 'quit\n' > inner.hal
run 'quit is for the top level only' <<'HAL'
source inner.hal
Quit
print never
HAL
rm -f t.hal t.ini long.hal dos.hal cr.hal inner.hal
