#!/bin/bash
# Each line of cases is one bad file (printf format); the message names file, line and reason.
while IFS= read -r text; do
    printf "$text" > bad.ini
    inivalue -e bad.ini 2>&1
    echo "=> $?"
done <<'CASES'
[A\nX=1\n
[]\n
[1A]\n
[A B]\n
X=1\n
[A]\nX\n
[A]\n=1\n
[A]\n1X=2\n
[A]\nX-Y=2\n
[A]\nX+Y=2\n
[7-z]\na.b=3\n
[A]\nX=\\x4\n
[A]\nX=\\xzz\n
[A]\nX=\\0\n
[A]\nX=\\ud800\n
[A]\nX=\\U00110000\n
[A]\nX=\\x80\n
[A]\nX=1\\\n
#INCLUDE bad.ini\n
#INCLUDED\n
#INCLUDE nowhere.ini\n
[A]\nX=\\q\n[A] tail\nY=2\n
\357\273\277[A]\nX=1\n
CASES
rm -f bad.ini
inivalue -e missing.ini 2>&1
echo "=> $?"
