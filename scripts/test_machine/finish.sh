# Part of the machine's first process, after the command.
status=$?
printf '\nlevitas-test-machine: status %d\n' "$status"
echo o >/proc/sysrq-trigger
# The power goes off in the background; the first process must not end before.
sleep 60
