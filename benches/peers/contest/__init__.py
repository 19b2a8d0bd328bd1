"""The same rooms through quasilux and its peers: errors against time."""
