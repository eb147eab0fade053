#!/bin/sh
# One AIGER file for each property, from rover.v: needs yosys and berkeley-abc.  Outputs 6 and 7 are not used.
set -e
cd "$(dirname "$0")"
yosys -q -p "read_verilog rover.v; prep -flatten -top rover; techmap; opt -full; dffunmap; abc -g AND -fast; \
	opt_clean; aigmap; write_aiger -zinit -symbols rover_all.aig"
number=0
for name in bad1 bad2 bad3 bad3h bad4 bad5; do
	berkeley-abc -q "read_aiger rover_all.aig; cone -s -O $number; write_aiger rover_$name.aig"
	number=$((number + 1))
done
rm rover_all.aig
