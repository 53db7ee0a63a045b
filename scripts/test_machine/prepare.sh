# Part of the machine's first process, before the command: what a distribution's start-up does.
mount -t proc proc /proc
mount -t sysfs sysfs /sys
mount -t devtmpfs devtmpfs /dev
mkdir -p /dev/shm /dev/pts
ln -sfT /proc/self/fd /dev/fd  # what bash's <(...) names
mount -t tmpfs tmpfs /dev/shm
mount -t devpts devpts /dev/pts
mount -t configfs configfs /sys/kernel/config
ulimit -c 0
# An empty /tmp, without hiding a repository that lies in it.
mkdir -p /dev/repository
mount --bind "$LEVITAS_REPOSITORY" /dev/repository
mount -t tmpfs tmpfs /tmp
if [ ! -d "$LEVITAS_REPOSITORY" ]; then
  mkdir -p "$LEVITAS_REPOSITORY"
  mount --bind /dev/repository "$LEVITAS_REPOSITORY"
fi
# The console is a terminal; raw output leaves line ends and width alone.
stty -opost 2>/dev/null
ip link set lo up
ip route add 224.0.0.0/4 dev lo
